// SPDX-License-Identifier: Apache-2.0
#include "simd/label_costs.h"

namespace starfocus::simd::reference {
namespace {

// Returns the cost of label l at pixel n.
uint8_t CostLabel(const LabelRow& row, size_t n, size_t l) {
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

}  // namespace

void CostLabels(const LabelRow& row, size_t count, size_t places, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t l = 0; l < row.labels; ++l) cost[n * places + l] = CostLabel(row, n, l);
  }
}

}  // namespace starfocus::simd::reference
