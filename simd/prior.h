// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for the prior that a given disparity map adds to the cost of each label of a pixel.
// The prior of a label is the distance to the nearest trusted pixel with the label's disparity.
// Distances are propagated from pixel to pixel, for all labels at once.
#ifndef STARFOCUS_SIMD_PRIOR_H_
#define STARFOCUS_SIMD_PRIOR_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Costs of steps between pixels, and the largest value of a prior. A step to an adjacent pixel
// costs kBesideCost, and a step to a diagonally adjacent pixel kDiagonalCost. If a label differs
// from the labels of all trusted pixels within 8 pixels, the prior of the label is kMostPrior.
inline constexpr uint8_t kBesideCost = 3, kDiagonalCost = 4, kMostPrior = 24;

// A row of `count` pixels. Each pixel has `places` elements, one per label; `places` is a multiple
// of kSliceLanes. Pixel k is k * step pixels after pixel 0; step is 1 or -1.
struct PriorRow {
  uint8_t* prior;         // In and out: priors, [0, kMostPrior].
  const uint8_t* before;  // Finished priors of the previous row; null if there is no previous row.
  size_t places;
  ptrdiff_t step;
  size_t count;
};

namespace reference {

inline void Lessen(const uint8_t* from, int way, size_t places, uint8_t* prior) {
  for (size_t l = 0; l < places; ++l) {
    if (from[l] + way < prior[l]) prior[l] = static_cast<uint8_t>(from[l] + way);
  }
}

// Reduces the priors of each pixel, one pixel after the other. Priors propagate to a pixel from the
// previous pixel of the row and from the three adjacent pixels of the previous row. A pixel's prior
// is at most the prior of each adjacent source pixel, plus the cost of the step from the source
// pixel.
STARFOCUS_REFERENCE void SpreadPrior(const PriorRow& row) {
  const auto places = static_cast<ptrdiff_t>(row.places);
  for (size_t k = 0; k < row.count; ++k) {
    const ptrdiff_t at = static_cast<ptrdiff_t>(k) * row.step * places, next = row.step * places;
    uint8_t* prior = row.prior + at;
    if (k > 0) Lessen(prior - next, kBesideCost, row.places, prior);
    if (row.before == nullptr) continue;
    const uint8_t* before = row.before + at;
    Lessen(before, kBesideCost, row.places, prior);
    if (k > 0) Lessen(before - next, kDiagonalCost, row.places, prior);
    if (k + 1 < row.count) Lessen(before + next, kDiagonalCost, row.places, prior);
  }
}

// Adds prior[n] to cost[n] for n < count. Sums are limited to 255. `count` is a multiple of
// kSliceLanes.
STARFOCUS_REFERENCE void AddPrior(const uint8_t* prior, size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    const int sum = cost[n] + prior[n];
    cost[n] = static_cast<uint8_t>(sum < 255 ? sum : 255);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_PRIOR_H_
