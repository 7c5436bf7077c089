// SPDX-License-Identifier: Apache-2.0
// Weighted means of colours over windows that grow until they hold enough weight. A summed-area
// table makes the cost of a mean independent of the window's size.
#ifndef STARFOCUS_LIB_DEPTH_COLOUR_SUMS_H_
#define STARFOCUS_LIB_DEPTH_COLOUR_SUMS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"

namespace starfocus {

// Largest weight of a pixel. The sums of a window fit 32 bits, those of the table wrap around.
inline constexpr int32_t kMostColourWeight = 15;
// Half of the side of the largest window.
inline constexpr int32_t kMostWindow = 32;
// Fraction bits of a mean colour.
inline constexpr int32_t kMeanBits = 3;
inline constexpr int32_t kFullTrust = 256;

// Mean colour. The variance is the sum over the three colours, in the square of the colour's unit.
struct MeanColour {
  int32_t rgb[3];
  int32_t variance;
  int32_t trust;  // up to kFullTrust: share of the weight that was asked for
};

// Sums of the weights of all pixels above and left, of weighted colours, and of squared colours.
struct ColourSum {
  uint32_t weight, rgb[3], squares;
};

class ColourSums {
 public:
  // `sums` holds (rect.width + 1) * (rect.height + 1) elements.
  ColourSums(const Rect& rect, ColourSum* sums);

  // Adds row y, rows from the top down. `colours` and `weights` begin at the rectangle's left side.
  void AddRow(int32_t y, const uint8_t* colours, const uint8_t* weights);

  // Windows of a mean: half of the side of the first one and of the largest one, each twice the one
  // before, until they hold `need` of weight together.
  struct Growth {
    int32_t first, last, need;
  };
  MeanColour MeanAt(int32_t x, int32_t y, const Growth& growth) const;

 private:
  ColourSum Window(int32_t x, int32_t y, int32_t radius) const;

  Rect rect_;
  size_t stride_;
  ColourSum* sums_;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_COLOUR_SUMS_H_
