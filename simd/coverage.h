// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of the coverage map (lib/matting). Each kernel processes a row of kSliceLanes
// pixels.
#ifndef STARFOCUS_SIMD_COVERAGE_H_
#define STARFOCUS_SIMD_COVERAGE_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/samples.h"

namespace starfocus::simd {

// Geometry of a view for CoverPlaces, which finds the nearer pixels that occlude far pixels in the
// view. All disparities must have the same scale; any scale is permitted.
struct CoverView {
  int16_t along;  // movement in the view per unit of disparity, 15 fractional bits
  // Movement in the view that places the near pixel onto the far pixel, in the scale of
  // disparities.
  int16_t place;
  int16_t within;  // Largest deviation from `place` at which the near pixel covers the far pixel.
  int16_t least;   // A near pixel covers far pixels only if it is nearer by more than `least`.
};

// Largest distance, in columns and rows, of the pixels that SumNear adds.
inline constexpr int32_t kNearReach = 2;

// The pixels around a row of kSliceLanes pixels. All pointers point to the first pixel of the row.
// Rows are `stride` samples apart.
struct NearRows {
  const int16_t* light[3];
  const int16_t* disparity;  // disparity of the near surface
  // Weight of the pixel in a mean of the near surface's light, [0, 256].
  const int16_t* weight;
  ptrdiff_t stride;
  int16_t step;  // largest difference between the disparities of one surface
};

// Output of SumNear: sums of light, and sums of weights with 15 fractional bits.
struct NearSums {
  int16_t light[3][kSliceLanes];
  int16_t weight[kSliceLanes];
};

// Filter coefficients of SumNear, by the distance in columns and rows. The coefficients of all
// pixels sum to 118, so that with weights of 256 the total is less than 1 (15 fractional bits).
inline constexpr int16_t kNearTaps[kNearReach + 1][kNearReach + 1] = {
    {10, 8, 4}, {8, 7, 3}, {4, 3, 2}};

namespace reference {

// For each n < kSliceLanes, raises covered[n] to coverage[n] if near pixel n (disparity near[n])
// occludes far pixel n (disparity far[n]) in the view. CoverPlaces never lowers covered[n].
STARFOCUS_REFERENCE void CoverPlaces(const int16_t* near, const uint8_t* coverage,
                                     const int16_t* far, const CoverView& view, int16_t* covered) {
  for (size_t n = 0; n < kSliceLanes; ++n) {
    const int16_t nearer = Saturated(near[n] - far[n]);
    const int16_t beside = Saturated(Product15(nearer, view.along) - view.place);
    const bool covers = nearer > view.least && beside >= -view.within && beside <= view.within;
    if (covers && coverage[n] > covered[n]) covered[n] = coverage[n];
  }
}

// Sums the light around each pixel n < kSliceLanes. The sum includes the pixels within kNearReach
// whose near surface is the near surface of pixel n. The light of each pixel is multiplied by the
// pixel's weight and by a filter coefficient from kNearTaps. Each product is rounded half up.
STARFOCUS_REFERENCE void SumNear(const NearRows& rows, NearSums* sums) {
  *sums = {};
  for (int32_t y = -kNearReach; y <= kNearReach; ++y) {
    for (int32_t x = -kNearReach; x <= kNearReach; ++x) {
      const int16_t tap = kNearTaps[std::abs(y)][std::abs(x)];
      for (size_t n = 0; n < kSliceLanes; ++n) {
        const ptrdiff_t here = static_cast<ptrdiff_t>(n), there = here + y * rows.stride + x;
        const int16_t beyond = Saturated(rows.disparity[there] - rows.disparity[here]);
        if (beyond > rows.step || beyond < -rows.step) continue;
        const int32_t weight = rows.weight[there] * tap;
        sums->weight[n] = static_cast<int16_t>(sums->weight[n] + weight);
        for (int c = 0; c < 3; ++c) {
          const int16_t part = Product15(rows.light[c][there], weight);
          sums->light[c][n] = static_cast<int16_t>(sums->light[c][n] + part);
        }
      }
    }
  }
}

}  // namespace reference

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COVERAGE_H_
