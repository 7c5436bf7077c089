// SPDX-License-Identifier: Apache-2.0
// The colours of a surface where a picture shows it, carried on to where it does not: a pyramid of
// weighted means over cells of 4 x 4 pixels (pull-push).
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_PYRAMID_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_PYRAMID_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/carver.h"

namespace starfocus {

// Side of a cell of the lowest level in pixels.
inline constexpr int32_t kHairCell = 4;
// Colours have this many bits behind the point: their squared distances fit 32 bits.
inline constexpr int kMeanBits = 6;
// The weight of a pixel that is all of the surface, and of a cell whose colour is all known.
inline constexpr int kKnownBits = 8;
inline constexpr int32_t kFullyKnown = 1 << kKnownBits;

struct ColourMean {
  uint16_t rgb[3];  // kMeanBits
  uint16_t weight;  // [0, kFullyKnown]
};

// Adds pixels up.
class ColourSum {
 public:
  // `weight` is in [0, kFullyKnown]; at most 16 pixels, codes << kMeanBits: 27 bits.
  template <class T>
  void Add(const T* rgb, uint32_t weight) {
    for (int c = 0; c < 3; ++c) sums_[c] += weight * rgb[c];
    weight_ += weight;
  }
  ColourMean Mean() const;

 private:
  uint32_t sums_[3] = {}, weight_ = 0;
};

struct ColourLevel {
  int32_t columns, rows;
  ColourMean* means;

  ColourMean& At(int32_t x, int32_t y) const {
    return means[static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x)];
  }
};

// From the cells of the picture up to a single one.
struct ColourPyramid {
  static constexpr int kMostLevels = 16;
  int32_t count;
  ColourLevel levels[kMostLevels];
};
ColourPyramid TakeColourPyramid(int32_t width, int32_t height, Carver* carver);

// Completes the colours of the lowest level, whose weights say how much is known of each: the rest
// is what the cells above say. Returns false if nothing is known.
bool CarryOnColours(const ColourPyramid& pyramid);

// The colours of a cell's pixels, kMeanBits.
struct CellColours {
  int32_t rgb[kHairCell][kHairCell][3];
};
// Interpolates them from the cells of the lowest level, bilinearly.
void InterpolateCell(const ColourPyramid& pyramid, int32_t column, int32_t row,
                     CellColours* colours);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_PYRAMID_H_
