// SPDX-License-Identifier: Apache-2.0
// Kernels of what a given disparity map says about each label of a pixel: how far away the next
// pixel is that it trusts to be of that disparity. Distances are a cost, and spread from pixel to
// pixel for all labels at once.
#ifndef STARFOCUS_SIMD_PRIOR_H_
#define STARFOCUS_SIMD_PRIOR_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

// The cost of a label that a pixel beside this one has, of one diagonally beside it, and of one
// that none has within 8 pixels.
inline constexpr uint8_t kBesideCost = 3, kDiagonalCost = 4, kMostPrior = 24;

// A row of pixels with `places` labels each, a multiple of kSliceLanes. Pixel k lies k * step
// pixels behind the first one; step is 1 or -1.
struct PriorRow {
  uint8_t* prior;         // [0, kMostPrior], lessened
  const uint8_t* before;  // the same pixels of the row before, finished; null: there is none
  size_t places;
  ptrdiff_t step;
  size_t count;
};

namespace reference {

// Lessens the prior of each pixel, in their order, to what the pixel before it and the three beside
// it in the row before have, and the way from there.
void SpreadPrior(const PriorRow& row);

// cost[n] becomes cost[n] + prior[n], 255 at most, for n < count, a multiple of kSliceLanes.
void AddPrior(const uint8_t* prior, size_t count, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PRIOR_H_
