// SPDX-License-Identifier: Apache-2.0
// The kernel that averages a noisy disparity map over neighbours of the same surface.
#ifndef STARFOCUS_SIMD_SMOOTH_H_
#define STARFOCUS_SIMD_SMOOTH_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Neighbours of a pixel: up to so many rows, and columns as far away.
inline constexpr size_t kMostSmoothRows = 7;
// Neighbours of one colour count this much, others less by as much as their colours differ.
inline constexpr int32_t kMostSmoothWeight = 64;

// A row of pixels and the rows whose pixels it is averaged over, of each those from `radius` before
// the first one to `radius` behind the last one. Disparities come first, then, `plane` numbers
// apart, what ColourSample has of a colour, in its order.
struct SmoothRows {
  const int32_t* own;
  const int32_t* rows[kMostSmoothRows];
  size_t count;  // of rows
  size_t plane;
  int32_t radius, step;  // columns
  int32_t tolerance;     // by which disparities differ at most
};

struct SmoothSums {
  int32_t disparity, weights;  // below 2^27 and 2^13

  // Halves are rounded away from zero.
  int16_t Mean() const {
    const int32_t half = disparity < 0 ? -weights : weights;
    return static_cast<int16_t>((2 * disparity + half) / (2 * weights));
  }
};

namespace reference {

// smooth[n] becomes the mean disparity of the neighbours of pixel n < count whose disparities are
// within the tolerance of its own. Pixel n itself is one of them.
void SmoothDisparity(const SmoothRows& rows, size_t count, int16_t* smooth);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_SMOOTH_H_
