// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that compares captured views with the centre view. The kernel computes the cost of
// each label at each pixel of a row.
#ifndef STARFOCUS_SIMD_LABEL_COSTS_H_
#define STARFOCUS_SIMD_LABEL_COSTS_H_

#include <cstddef>
#include <cstdint>

#include "simd/match.h"
#include "simd/samples.h"

namespace starfocus::simd {

inline constexpr size_t kMostMatched = 16;  // largest number of side views

// Offsets in samples by which a label moves a pixel in a side view.
struct ViewMove {
  // Offset from the pixel's red sample in the centre view to the moved pixel's red sample in the
  // side view.
  int32_t at;
  // Offset in LabelRow::hidden from the pixel in the plane of the first view to the moved pixel in
  // the plane of the side view.
  int32_t hidden;
};

// A row of pixels, and the rules of the comparison.
struct LabelRow {
  const uint8_t* pixels;  // Red sample of the first pixel in the centre view.
  size_t plane;           // Distance in samples between the planes R, G and B, in all views.
  const ViewMove* moves;  // moves[l * views + k]: offsets of label l in side view k.
  // Planes with the number of hidden labels, or kViewEnds, of each pixel in each view; points to
  // the first pixel of the row in the plane of the first view. Null if all views see all pixels.
  const uint8_t* hidden;
  size_t labels;  // [1, 254].
  size_t views;   // Number of side views, [1, kMostMatched].
  // The sides from which SeenCost computes the cost, for views at any positions. If sides.count is
  // 0, views = arms * rings, and the members below define the cost.
  ViewSides sides;
  size_t arms, rings;  // The side views lie on `arms` rays and `rings` rings around the centre.
  bool one_side;       // True to use the views on the best side of a pixel, false to use all views.
  bool ends;           // True if some values of `hidden` may be kViewEnds.
  // True to replace a view only at pixels outside the view, and to limit the differences of views
  // in which a surface hides the pixel.
  bool limits;
};

namespace reference {

// Returns the cost of label l at pixel n.
inline uint8_t CostLabel(const LabelRow& row, size_t n, size_t l) {
  const size_t views = row.views;
  const ViewMove* moves = row.moves + l * views;
  const auto label = static_cast<uint8_t>(l);
  uint8_t of_view[kMostMatched];
  uint8_t* differences[kMostMatched];
  const uint8_t* hidden[kMostMatched];
  for (size_t k = 0; k < views; ++k) {
    differences[k] = of_view + k;
    const uint8_t* pixel = row.pixels + n;
    MatchView(pixel, pixel + moves[k].at, row.plane, 1, differences[k]);
    if (row.hidden != nullptr) hidden[k] = row.hidden + n + moves[k].hidden;
  }
  uint8_t cost = 0;
  if (row.sides.count > 0) {
    SeenCost(differences, row.hidden == nullptr ? nullptr : hidden, label, row.sides, 1, &cost);
    return cost;
  }
  if (row.hidden != nullptr) {
    const uint8_t last = row.limits ? uint8_t{kViewEnds - 1} : label;
    for (size_t k = 0; k < views; ++k) {
      const size_t half = row.arms / 2;
      if (k % row.arms >= half || (row.limits && !row.ends)) continue;
      StandIn(hidden[k], hidden[k + half], last, 1, differences[k], differences[k + half]);
    }
    if (row.limits) LimitHidden(hidden, label, views, 1, differences);
  }
  if (row.one_side) {
    LeastSide(differences, row.arms, row.rings, 1, &cost);
  } else {
    MeanCost(differences, views, 1, &cost);
  }
  return cost;
}

// Sets cost[n * places + l] to the cost of label l at pixel n < count. With sides, SeenCost
// computes the cost from the differences of the views. Without sides, StandIn and LimitHidden first
// change the differences of hidden views. LeastSide or MeanCost then computes the cost from the
// differences. `places` is a multiple of kSliceLanes and at least SliceSamples(labels). For each
// pixel, SliceSamples(labels) costs are written.
STARFOCUS_REFERENCE void CostLabels(const LabelRow& row, size_t count, size_t places,
                                    uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t l = 0; l < row.labels; ++l) cost[n * places + l] = CostLabel(row, n, l);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LABEL_COSTS_H_
