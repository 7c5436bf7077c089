// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that compares captured views with the centre view. It computes the cost of each
// disparity at each pixel of a row.
#ifndef STARFOCUS_SIMD_LABEL_COSTS_H_
#define STARFOCUS_SIMD_LABEL_COSTS_H_

#include <cstddef>
#include <cstdint>

#include "simd/match.h"

namespace starfocus::simd {

inline constexpr size_t kMostMatched = 16;  // largest number of side views

// Offsets of a label in a side view, in samples from the pixel itself.
struct ViewMove {
  int32_t at;  // from the pixel's red sample in the centre view to its red sample in the side view
  // from the pixel in the first view's plane of hidden labels to its place in this view's plane
  int32_t hidden;
};

// A row of pixels, and the rules of the comparison.
struct LabelRow {
  const uint8_t* pixels;  // red sample of the first pixel in the centre view
  size_t plane;           // samples from red to green, and from green to blue, in all views
  const ViewMove* moves;  // of each side view, for each label
  // number of hidden labels at the first pixel's place in the first view, or kViewEnds; null: all
  // views see all pixels
  const uint8_t* hidden;
  size_t labels;       // [1, 254]
  size_t arms, rings;  // as in LeastSide
  bool one_side;       // true: uses the views on the best side of a pixel; false: all views
  bool ends;           // true: some values of `hidden` may be kViewEnds
  bool limits;         // true: limits hidden views, and replaces only views that end
};

namespace reference {

// Sets cost[n * places + l] to the cost of label l at pixel n < count. It is LeastSide or MeanCost
// of the differences, after StandIn and LimitHidden have changed those of hidden views. `places` is
// a multiple of kSliceLanes, at least SliceSamples(labels); SliceSamples(labels) costs of each
// pixel are written.
void CostLabels(const LabelRow& row, size_t count, size_t places, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LABEL_COSTS_H_
