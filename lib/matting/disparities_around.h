// SPDX-License-Identifier: Apache-2.0
// Copies the disparities of a tile and its surroundings, and smooths near disparities.
#ifndef STARFOCUS_LIB_MATTING_DISPARITIES_AROUND_H_
#define STARFOCUS_LIB_MATTING_DISPARITIES_AROUND_H_

#include <cstring>

#include "lib/matting/coverage_input.h"

namespace starfocus {

// Disparities of a tile and of kAround pixels on each side of the tile. Beyond the picture, the
// outermost pixels of the picture are repeated.
template <int32_t kAround>
struct DisparitiesAround {
  static constexpr int32_t kSide = kCoverageTile + 2 * kAround;
  int16_t disparity[kSide * kSide];

  DisparitiesAround() = default;
  DisparitiesAround(const Input& input, int32_t column, int32_t row) {
    const int32_t left = column * kCoverageTile - kAround, top = row * kCoverageTile - kAround;
    for (int32_t y = 0; y < kSide; ++y) {
      const int16_t* from = input.disparity.Row(Clamp(top + y, 0, input.height - 1));
      int16_t* to = disparity + y * kSide;
      if (left >= 0 && left + kSide <= input.width) {
        std::memcpy(to, from + left, kSide * sizeof(*to));
        continue;
      }
      for (int32_t x = 0; x < kSide; ++x) to[x] = from[Clamp(left + x, 0, input.width - 1)];
    }
  }
  static constexpr int32_t At(int32_t x, int32_t y) { return (y + kAround) * kSide + x + kAround; }
};

// Returns a weighted mean of the disparities in the 5x5 pixels around `at`. Only disparities that
// differ from `near` by at most 2 pixels are included. Returns `near` if no disparity is included.
template <class Disparities>
int16_t SmoothNear(const Disparities& around, int32_t at, int32_t near) {
  constexpr int32_t kWithin = 2 << kDisparityBits;
  constexpr int32_t kWeights[3] = {6, 4, 1};
  int32_t sum = 0, weights = 0;
  for (int32_t y = -2; y <= 2; ++y) {
    for (int32_t x = -2; x <= 2; ++x) {
      const int32_t disparity = around.disparity[at + y * Disparities::kSide + x];
      if (Abs(disparity - near) > kWithin) continue;
      const int32_t weight = kWeights[Abs(x)] * kWeights[Abs(y)];
      sum += weight * (disparity - near);
      weights += weight;
    }
  }
  if (weights == 0) return static_cast<int16_t>(near);
  const int32_t half = sum < 0 ? -(weights / 2) : weights / 2;
  return static_cast<int16_t>(near + (sum + half) / weights);
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_DISPARITIES_AROUND_H_
