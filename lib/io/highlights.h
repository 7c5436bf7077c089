// SPDX-License-Identifier: Apache-2.0
// Highlights: computes the light beyond white that clipped samples represent
// (FullConfig.highlights).
#ifndef STARFOCUS_LIB_IO_HIGHLIGHTS_H_
#define STARFOCUS_LIB_IO_HIGHLIGHTS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/io/input.h"

namespace starfocus {

// Returns the largest size of a lamp in pixels: 1/32 of the picture's width, from 16 to 128. Larger
// highlights are bright walls or sky and keep their captured brightness.
constexpr int32_t LargestLamp(int32_t width) { return Clamp(width / 32, 16, 128); }

// Returns the number of pixels around a highlight that decide whether the highlight is a lamp.
constexpr int32_t LampRadius(int32_t lamp) { return 2 * lamp; }

// A pixel is a highlight if at least two of its codes are kFirstExcess or more. Lamps of any colour
// are highlights. Darker saturated colours are not highlights, because at most one of their codes
// reaches kFirstExcess.
inline constexpr int32_t kFirstExcess = 251;

// Returns true if pixels of `rect` may show light of highlights beyond white: some view has a
// highlight at most `reach` pixels away. Returns false if a single highlight larger than a lamp
// covers the whole area within reach.
bool HasHighlights(const Input& in, const Rect& rect, int32_t reach);

// Run of highlights in a row or column: pixels [first, last]. `length` is at most LampRadius and
// applies to all pixels of the run.
struct LampLength {
  int16_t view = -1;  // -1: no run
  uint16_t line = 0, first = 0, last = 0, length = 0;
};

// Cache of runs of highlights, so that the pixels of a run do not count the run again. Each worker
// uses one cache while it renders a block.
struct LampLengths {
  static constexpr int32_t kCount = 1024;  // Number of entries, a power of two.
  static constexpr int kPieceBits = 6;     // 2^kPieceBits pixels of a line share an entry.

  LampLength along[kCount], down[kCount];

  void Clear() {
    for (LampLength& run : along) run = LampLength();
    for (LampLength& run : down) run = LampLength();
  }
};

// Returns an input whose light is the excess of the highlights of `captured`, at layer 0. Clears
// `runs`, its cache. `captured` and `runs` must outlive the result. The excess of a highlight is a
// part of its light, so that it keeps its colour. The part rises with the square of the second
// largest code, from kFirstExcess on, and is the whole light if this code is clipped. Other pixels
// have no excess. `highlights` is FullConfig.highlights.
//
// A highlight that is at most LargestLamp pixels high or wide has its full excess. The excess of
// larger highlights decreases to 0 at twice this size. Highlights that reach the edge of the
// picture count as large.
Input ExcessOf(const Input& captured, double highlights, LampLengths* runs);

// Last step of rendering highlights: adds the rendered excess in `sums`, which have `shift`
// fractional bits, to the light of `codes`. Results beyond white are clipped to white. Sums of 0 do
// not change the codes.
void AddExcess(const Input& excess, const uint32_t* sums, size_t count, int shift, uint8_t* codes);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_HIGHLIGHTS_H_
