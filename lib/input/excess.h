// SPDX-License-Identifier: Apache-2.0
// Highlights: what clipped samples stand for beyond white (starfocus_config.highlights).
#ifndef STARFOCUS_LIB_INPUT_EXCESS_H_
#define STARFOCUS_LIB_INPUT_EXCESS_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/input/view_reader.h"

namespace starfocus {

// Lamps are no larger than this, in pixels: a 32nd of the picture's width, 16 to 128. Highlights of
// more are bright walls or sky, which are as white as they look.
constexpr int32_t LargestLamp(int32_t width) { return Clamp(width / 32, 16, 128); }

// Pixels around a highlight that decide whether it is a lamp.
constexpr int32_t LampReach(int32_t lamp) { return 2 * lamp; }

// A pixel is a highlight when two of its codes are at least kFirstExcess: nearly clipped are lamps
// of any colour, and of saturated colours that are not so bright one code at most.
inline constexpr int32_t kFirstExcess = 251;
bool IsHighlight(const uint8_t* codes);

// Highlights that follow each other along a row or a column: pixels [first, last] of one such run,
// which all have its length, LampReach at most.
struct LampRun {
  int16_t view = -1;  // -1: none
  uint16_t line = 0, first = 0, last = 0, length = 0;
};

// The runs that were found last, so that neighbours do not count the same pixels again. A worker
// has one for as long as it renders a block.
struct LampRuns {
  static constexpr int32_t kCount = 1024;  // a power of two
  static constexpr int kSpanBits = 6;      // a line has a place for each 64 pixels

  LampRun along[kCount], down[kCount];

  void Clear() {
    for (LampRun& run : along) run = LampRun();
    for (LampRun& run : down) run = LampRun();
  }
};

// Captured views of which highlights up to `lamp` pixels are lamps, at layer 0.
struct ExcessViews {
  ViewReader views;
  int32_t width, height, lamp;  // of the picture; LargestLamp
  LampRuns* runs;               // of any views of these pictures
};

// Returns a reader of what highlights have beyond white, as light; `views` must outlive it. For a
// clipped sample that is one more white: it rises with the square of the code from kFirstExcess on.
// Other pixels are 0. All of it counts where the highlight is at most views.lamp pixels high or
// wide, less beyond, and nothing from twice as many on, or where it goes on beyond the picture's
// edges.
ViewReader ReaderOf(const ExcessViews& views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_EXCESS_H_
