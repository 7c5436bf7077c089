// SPDX-License-Identifier: Apache-2.0
// Kernels of the coverage map (lib/coverage). Each works on a row of kSliceLanes pixels.
#ifndef STARFOCUS_SIMD_COVERAGE_H_
#define STARFOCUS_SIMD_COVERAGE_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Where a nearer pixel lies before a place of a view. Disparities have any scale.
struct CoverView {
  int16_t along;   // what a unit of disparity moves by in the view, 15 fractional bits
  int16_t place;   // the move that leads to the place, in the scale of disparities
  int16_t within;  // moves that differ from it by at most this lead there, too
  int16_t least;   // a nearer pixel is nearer by more than this
};

// Pixels around one that SumNear takes.
inline constexpr int32_t kNearReach = 2;

// Rows of pixels around the first of kSliceLanes pixels, `stride` samples apart.
struct NearRows {
  const int16_t* light[3];
  const int16_t* disparity;  // of the near surface
  const int16_t* weight;     // [0, 256]: how much a pixel shows of the near surface's light
  ptrdiff_t stride;
  int16_t step;  // disparities of one surface differ by at most this
};

// The sums of light and of weights that SumNear writes; the latter have 15 fractional bits.
struct NearSums {
  int16_t light[3][kSliceLanes];
  int16_t weight[kSliceLanes];
};

namespace reference {

// Raises covered[n] to coverage[n] for those pixels n < kSliceLanes of which a nearer surface, at
// disparity near[n], lies before the place of the far one, at far[n].
void CoverPlaces(const int16_t* near, const uint8_t* coverage, const int16_t* far,
                 const CoverView& view, int16_t* covered);

// Sums the light of the pixels within kNearReach of each pixel n < kSliceLanes that are of its near
// surface: by weight, and the more the closer they are. Each product is rounded halves up.
void SumNear(const NearRows& rows, NearSums* sums);

}  // namespace reference

// How much a pixel so many pixels aside and below counts; those of all of them sum to 118, so that
// with weights of 256 all weigh less than 1.
inline constexpr int16_t kNearTaps[kNearReach + 1][kNearReach + 1] = {
    {10, 8, 4}, {8, 7, 3}, {4, 3, 2}};

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_COVERAGE_H_
