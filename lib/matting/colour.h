// SPDX-License-Identifier: Apache-2.0
// Colours of pixels, their weighted sums, and their positions relative to other colours.
#ifndef STARFOCUS_LIB_MATTING_COLOUR_H_
#define STARFOCUS_LIB_MATTING_COLOUR_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/transfer.h"

namespace starfocus {

// Linear light of the samples R, G and B of a pixel.
struct Colour {
  int16_t rgb[3];

  int32_t operator[](int c) const { return rgb[c]; }
};

// Weighted sum of colours; T must hold the sum of the products.
template <class T>
struct ColourSum {
  T rgb[3] = {}, weight = 0;

  template <class Rgb>
  void Add(const Rgb& colour, T by) {
    for (int c = 0; c < 3; ++c) rgb[c] += by * colour[c];
    weight += by;
  }
  // Returns a sample of the mean of colours without negative samples, or 0 without colours.
  T Mean(int c) const { return weight == 0 ? 0 : (rgb[c] + weight / 2) / weight; }
};

// Returns light within the range of light that is separated from other light.
inline int16_t LimitedLight(int32_t light) {
  return static_cast<int16_t>(Clamp(light, ranges::kUnmixed.low, ranges::kUnmixed.high));
}

// Position of a mixed colour relative to the line from the far to the near colour: the product of
// near - far and mixed - far, and the squares of near - far (contrast) and of mixed - far. Colours
// are in units of white / 255.
struct ColourLine {
  int64_t along = 0, contrast = 0, distance = 0;
};

// Compares colours with kBits fractional bits. Halves are rounded away from 0, so that inverted
// colours have the same result.
template <int kBits, class Rgb>
ColourLine ColourLineOf(const Rgb& near, const Rgb& far, const Rgb& mixed) {
  const auto difference = [](int32_t a, int32_t b) {
    const int64_t size = RoundShift(Abs(a - b), kLightBits - kBits);
    return a < b ? -size : size;
  };
  ColourLine line;
  for (int c = 0; c < 3; ++c) {
    const int64_t whole = difference(near[c], far[c]), part = difference(mixed[c], far[c]);
    line.along += part * whole;
    line.contrast += whole * whole;
    line.distance += part * part;
  }
  return line;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COLOUR_H_
