// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that averages a noisy disparity map over neighbours of the same surface.
#ifndef STARFOCUS_SIMD_SMOOTH_H_
#define STARFOCUS_SIMD_SMOOTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Largest number of rows that a pixel is averaged over.
inline constexpr size_t kMostSmoothRows = 7;
// Weight of a neighbour of the same colour. It decreases with the difference of the colours, to at
// least 1.
inline constexpr int32_t kMostSmoothWeight = 64;

// A row of pixels and the rows that it is averaged over. All pointers are to the row's first pixel,
// and `radius` more pixels lie on both sides. A row has four planes, `plane` numbers apart:
// disparity, and the members sum, red_green and green_blue of ColourSample.
struct SmoothRows {
  const int32_t* own;
  const int32_t* rows[kMostSmoothRows];
  size_t count;  // number of rows
  size_t plane;
  int32_t radius, step;  // neighbours are every `step`th column within `radius`
  int32_t tolerance;     // largest difference of disparities within a surface
};

// Sums over the neighbours of a pixel.
struct SmoothSums {
  int32_t disparity, weights;  // weighted disparities, below 2^27, and weights, below 2^13

  // Returns the mean, with halves rounded away from zero.
  int16_t Mean() const {
    const int32_t half = disparity < 0 ? -weights : weights;
    return static_cast<int16_t>((2 * disparity + half) / (2 * weights));
  }
};

namespace reference {

// Sets smooth[n] to the mean disparity of the neighbours of pixel n < count whose disparities are
// within the tolerance of its own. Pixel n itself is one of them.
void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* smooth);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SMOOTH_H_
