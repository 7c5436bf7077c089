// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that averages a noisy disparity map over neighbouring pixels on one surface.
#ifndef STARFOCUS_SIMD_SMOOTH_H_
#define STARFOCUS_SIMD_SMOOTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/colours.h"
#include "simd/samples.h"

namespace starfocus::simd {

// Largest number of rows over which a pixel is averaged.
inline constexpr size_t kMostSmoothRows = 7;
// Weight of a neighbour of equal colour. The weight of a neighbour decreases with the difference of
// the colours, down to 1.
inline constexpr int32_t kMostSmoothWeight = 64;

// A row of pixels (`own`) and the rows over which its pixels are averaged. Each pointer points to
// the first pixel of a row. `radius` more pixels at both ends of a row must be readable. A row has
// four planes, which are `plane` elements apart: disparity, and the members sum, red_green and
// green_blue of ColourSample.
struct SmoothRows {
  const int32_t* own;
  const int32_t* rows[kMostSmoothRows];
  size_t count;  // number of rows
  size_t plane;
  int32_t radius, step;  // Neighbours are in every `step`-th column within `radius`.
  int32_t tolerance;     // Largest difference of disparities within a surface.
};

// Weighted sums over the neighbours of a pixel.
struct SmoothSums {
  // Sum of weighted disparities, below 2^27, and sum of weights, below 2^13.
  int32_t disparity, weights;

  // Returns the mean disparity. Halves are rounded away from zero.
  int16_t Mean() const {
    const int32_t half = disparity < 0 ? -weights : weights;
    return static_cast<int16_t>((2 * disparity + half) / (2 * weights));
  }
};

namespace reference {

inline int32_t SmoothWeight(const int32_t* own, const int32_t* other, size_t plane) {
  const auto differs = [&](size_t k) { return own[k * plane] - other[k * plane]; };
  const int32_t difference = ColourDifference(differs(1), differs(2), differs(3));
  return difference < kMostSmoothWeight ? kMostSmoothWeight - difference : 1;
}

// Sets smooth[n] to the weighted mean disparity over neighbours of pixel n, for n < count. The mean
// includes pixel n and all neighbours whose disparity differs from the disparity of pixel n by at
// most `tolerance`.
STARFOCUS_REFERENCE void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* smooth) {
  for (size_t n = 0; n < count; ++n) {
    const int32_t* own = rows.own + n;
    SmoothSums sums = {0, 0};
    for (size_t k = 0; k < rows.count; ++k) {
      for (int32_t x = -rows.radius; x <= rows.radius; x += rows.step) {
        const int32_t* other = rows.rows[k] + static_cast<ptrdiff_t>(n) + x;
        const int32_t apart = *other < *own ? *own - *other : *other - *own;
        if (apart > rows.tolerance) continue;
        const int32_t weight = SmoothWeight(own, other, rows.plane);
        sums.disparity += weight * *other;
        sums.weights += weight;
      }
    }
    smooth[n] = sums.Mean();
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SMOOTH_H_
