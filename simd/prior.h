// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for the prior of a given disparity map: the cost of each label of a pixel. The cost
// is the distance to the nearest pixel that is trusted to have that disparity. Distances spread
// from pixel to pixel, for all labels at once.
#ifndef STARFOCUS_SIMD_PRIOR_H_
#define STARFOCUS_SIMD_PRIOR_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// Cost of a label that an adjacent or a diagonally adjacent pixel has, and of a label that no pixel
// within 8 pixels has.
inline constexpr uint8_t kBesideCost = 3, kDiagonalCost = 4, kMostPrior = 24;

// A row of pixels with `places` labels each, a multiple of kSliceLanes. Pixel k is k * step pixels
// after the first one; step is 1 or -1.
struct PriorRow {
  uint8_t* prior;         // in and out: [0, kMostPrior], reduced
  const uint8_t* before;  // the same pixels of the previous row, finished; null: no previous row
  size_t places;
  ptrdiff_t step;
  size_t count;
};

namespace reference {

// Reduces the prior of each pixel, in order. The sources are the previous pixel and the three
// adjacent pixels in the previous row. The result is at most the prior of each source plus the cost
// of the step from there.
void SpreadPrior(const PriorRow& row);

// Sets cost[n] to cost[n] + prior[n], at most 255, for n < count, a multiple of kSliceLanes.
void AddPrior(const uint8_t* prior, size_t count, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PRIOR_H_
