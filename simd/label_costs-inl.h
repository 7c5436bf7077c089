// SPDX-License-Identifier: Apache-2.0
// Vector code of the functions in label_costs.h. This file is included once per SIMD target.
#if defined(STARFOCUS_SIMD_LABEL_COSTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef STARFOCUS_SIMD_LABEL_COSTS_INL_H_
#undef STARFOCUS_SIMD_LABEL_COSTS_INL_H_
#else
#define STARFOCUS_SIMD_LABEL_COSTS_INL_H_
#endif

#include "simd/label_costs.h"
#include "simd/match-inl.h"

HWY_BEFORE_NAMESPACE();
namespace starfocus::simd {
namespace HWY_NAMESPACE {

// Colour differences between each side view and the centre view, at kMatchPixels pixels.
struct ViewDifferences {
  uint8_t values[kMostMatched][kMatchPixels];
  uint8_t* rows[kMostMatched];
};

// Replaces or limits the differences of views that do not show the pixels at the disparity of
// `label`. hidden[k] is the number of hidden labels of the first pixel in view k.
HWY_INLINE void ChangeHidden(const LabelRow& row, const uint8_t* const* hidden, uint8_t label,
                             ViewDifferences* differences) {
  const size_t views = row.views, half = row.arms / 2;
  if (!row.limits || row.ends) {
    const uint8_t last = row.limits ? uint8_t{kViewEnds - 1} : label;
    for (size_t k = 0; k < views; ++k) {
      if (k % row.arms >= half) continue;
      StandIn(hidden[k], hidden[k + half], last, kMatchPixels, differences->rows[k],
              differences->rows[k + half]);
    }
  }
  if (row.limits) LimitHidden(hidden, label, views, kMatchPixels, differences->rows);
}

inline void CostLabels(const LabelRow& row, size_t count, size_t places,
                       uint8_t* HWY_RESTRICT cost) {
  const size_t views = row.views;
  ViewDifferences differences;
  for (size_t k = 0; k < views; ++k) differences.rows[k] = differences.values[k];
  uint8_t costs[kSliceLanes][kMatchPixels] = {};
  for (size_t n = 0; n < count; n += kMatchPixels) {
    const uint8_t* pixels = row.pixels + n;
    const size_t left = count - n;
    for (size_t l = 0; l < row.labels; ++l) {
      const ViewMove* moves = row.moves + l * views;
      for (size_t k = 0; k < views; ++k) {
        MatchView(pixels, pixels + moves[k].at, row.plane, kMatchPixels, differences.rows[k]);
      }
      const auto label = static_cast<uint8_t>(l);
      const uint8_t* hidden[kMostMatched] = {};
      if (row.hidden != nullptr) {
        for (size_t k = 0; k < views; ++k) hidden[k] = row.hidden + n + moves[k].hidden;
        if (row.sides.count == 0) ChangeHidden(row, hidden, label, &differences);
      }
      uint8_t* here = costs[l % kSliceLanes];
      if (row.sides.count > 0) {
        SeenCost(differences.rows, row.hidden == nullptr ? nullptr : hidden, label, row.sides,
                 kMatchPixels, here);
      } else if (row.one_side) {
        LeastSide(differences.rows, row.arms, row.rings, kMatchPixels, here);
      } else {
        MeanCost(differences.rows, views, kMatchPixels, here);
      }
      if (l % kSliceLanes + 1 < kSliceLanes && l + 1 < row.labels) continue;
      uint8_t* of_pixel = cost + n * places + l / kSliceLanes * kSliceLanes;
      GatherLabels(costs[0], left < kMatchPixels ? left : kMatchPixels, of_pixel, places);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace starfocus::simd
HWY_AFTER_NAMESPACE();

#endif
