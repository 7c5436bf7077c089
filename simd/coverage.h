// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of the coverage map (lib/coverage). Each processes a row of kSliceLanes pixels.
#ifndef STARFOCUS_SIMD_COVERAGE_H_
#define STARFOCUS_SIMD_COVERAGE_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Geometry of a view for CoverPlaces, which finds the nearer pixels that occlude a place in the
// view. Disparities may have any scale.
struct CoverView {
  int16_t along;   // move of a unit of disparity in the view, 15 fractional bits
  int16_t place;   // move that leads to the place, in the scale of disparities
  int16_t within;  // largest deviation from that move which still covers the place
  int16_t least;   // a nearer pixel is nearer by more than this
};

// Distance in pixels within which SumNear adds pixels.
inline constexpr int32_t kNearReach = 2;

// Rows of pixels around the first of kSliceLanes pixels, `stride` samples apart.
struct NearRows {
  const int16_t* light[3];
  const int16_t* disparity;  // disparity of the near surface
  const int16_t* weight;     // [0, 256]: weight of the near surface's light in the pixel
  ptrdiff_t stride;
  int16_t step;  // disparities of one surface differ by at most this
};

// Output of SumNear: sums of light, and sums of weights with 15 fractional bits.
struct NearSums {
  int16_t light[3][kSliceLanes];
  int16_t weight[kSliceLanes];
};

namespace reference {

// Raises covered[n] to coverage[n] for each pixel n < kSliceLanes whose near surface, at disparity
// near[n], occludes the place of the far surface, at disparity far[n].
void CoverPlaces(const int16_t* near, const uint8_t* coverage, const int16_t* far,
                 const CoverView& view, int16_t* covered);

// Sums the light of the pixels within kNearReach of each pixel n < kSliceLanes that belong to the
// same near surface. Light is multiplied by its weight and by kNearTaps. Each product is rounded
// halves up.
void SumNear(const NearRows& rows, NearSums* sums);

}  // namespace reference

// Weights of pixels by their distance in columns and rows. The weights of all pixels sum to 118, so
// that with weights of 256 the total is less than 1.
inline constexpr int16_t kNearTaps[kNearReach + 1][kNearReach + 1] = {
    {10, 8, 4}, {8, 7, 3}, {4, 3, 2}};

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COVERAGE_H_
