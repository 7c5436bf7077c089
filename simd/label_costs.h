// SPDX-License-Identifier: Apache-2.0
// The kernel that compares captured views with the centre view: what each disparity costs at each
// pixel of a row.
#ifndef STARFOCUS_SIMD_LABEL_COSTS_H_
#define STARFOCUS_SIMD_LABEL_COSTS_H_

#include <cstddef>
#include <cstdint>

#include "simd/match.h"

namespace starfocus::simd {

inline constexpr size_t kMostMatched = 16;  // side views

// Where a side view shows a label, in samples from the pixel itself.
struct ViewMove {
  int32_t at;      // from the pixel's red in the centre to its red in the view
  int32_t hidden;  // from the pixel in the first view's hidden labels to its place in this view's
};

// A row of pixels, and how they are compared.
struct LabelRow {
  const uint8_t* pixels;  // red of the first pixel in the centre
  size_t plane;           // samples from red to green, and to blue, in all views
  const ViewMove* moves;  // of each side view, for each label
  const uint8_t* hidden;  // how many labels are hidden where the first view shows the first pixel,
                          // or kViewEnds; null: all views see all pixels
  size_t labels;          // [1, 254]
  size_t arms, rings;     // as for LeastSide
  bool one_side;          // by the views on one side of a pixel, whichever; otherwise by all
  bool ends;              // there may be kViewEnds
  bool limits;            // hidden views are limited, and only those that end stood in for
};

namespace reference {

// cost[n * places + l] becomes what label l costs at pixel n < count: by LeastSide or MeanCost of
// the differences, of which StandIn and LimitHidden have changed those of hidden views. `places` is
// a multiple of kSliceLanes, SliceSamples(labels) at least; of each pixel so many are written.
void CostLabels(const LabelRow& row, size_t count, size_t places, uint8_t* cost);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LABEL_COSTS_H_
