// SPDX-License-Identifier: Apache-2.0
// Building blocks of the kernel that compares captured views with the centre view (label_costs.h).
// Each function processes one label of a row of pixels. The vector code reads and writes whole
// groups of kSliceLanes samples.
#ifndef STARFOCUS_SIMD_MATCH_H_
#define STARFOCUS_SIMD_MATCH_H_

#include <cstddef>
#include <cstdint>

#include "simd/samples.h"

namespace starfocus::simd {

// Upper limit of the difference between two pixels, which is the sum over R, G and B in grey
// levels. Larger differences are clamped, because such pixels do not match in any case.
inline constexpr int kMostDifference = 60;
// Difference that is assumed if no view shows a pixel; the value corresponds to a poor match.
inline constexpr int kUnknownDifference = 48;
// Upper limits of the difference of a view that is known not to see the pixel. The limit is
// kHiddenDifference if another view sees the pixel, and kUnseenDifference if no view sees the
// pixel.
inline constexpr int kHiddenDifference = 18, kUnseenDifference = 27;
// Number of hidden labels that is stored for pixels outside a view. Inside a view, the hidden
// labels of a pixel are always the lowest labels, so it is enough to store their number.
inline constexpr uint8_t kViewEnds = 255;
// Factor between differences and costs. Costs are in [0, 240].
inline constexpr int kCostScale = 4;

// Sets of side views. Bit k of a mask is 1 if side view k belongs to the set. Each set has a view.
struct ViewSides {
  const uint16_t* masks;
  size_t count;
};

// Returns 256 * kCostScale / views, rounded up. The product of this factor and the sum of the
// differences of `views` views is 256 times the cost. The product is less than 2^16.
constexpr uint32_t MeanFactor(size_t views) {
  return static_cast<uint32_t>((256 * kCostScale + views - 1) / views);
}

namespace reference {

// Sets difference[n] to the difference between pixel n of the centre view and pixel n of a side
// view, clamped to kMostDifference. In both views, the planes R, G and B are `plane` samples apart.
STARFOCUS_REFERENCE void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane,
                                   size_t count, uint8_t* difference) {
  for (size_t n = 0; n < count; ++n) {
    int sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const int apart = view[n + c * plane] - centre[n + c * plane];
      sum += apart < 0 ? -apart : apart;
    }
    difference[n] = static_cast<uint8_t>(sum < kMostDifference ? sum : kMostDifference);
  }
}

// Replaces a view that does not see a pixel with the opposite view. View a sees pixel n if
// hidden_a[n] <= label, and the opposite view b sees pixel n if hidden_b[n] <= label. If only one
// of views a and b sees pixel n, the difference of the other view is set to the difference of the
// view that sees the pixel. If neither view sees pixel n, both differences are set to
// kUnknownDifference.
STARFOCUS_REFERENCE void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label,
                                 size_t count, uint8_t* a, uint8_t* b) {
  for (size_t n = 0; n < count; ++n) {
    const bool by_a = hidden_a[n] <= label, by_b = hidden_b[n] <= label;
    const uint8_t of_a = a[n], of_b = b[n];
    a[n] = by_a ? of_a : by_b ? of_b : uint8_t{kUnknownDifference};
    b[n] = by_b ? of_b : by_a ? of_a : uint8_t{kUnknownDifference};
  }
}

// Limits the differences of views that do not see a pixel. View k does not see pixel n if
// hidden[k][n] > label. The limit is kHiddenDifference if any view sees pixel n, and
// kUnseenDifference if no view sees pixel n.
STARFOCUS_REFERENCE void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views,
                                     size_t count, uint8_t* const* differences) {
  for (size_t n = 0; n < count; ++n) {
    bool seen = false;
    for (size_t k = 0; k < views; ++k) seen = seen || hidden[k][n] <= label;
    const uint8_t most = seen ? kHiddenDifference : kUnseenDifference;
    for (size_t k = 0; k < views; ++k) {
      uint8_t& difference = differences[k][n];
      if (hidden[k][n] > label && difference > most) difference = most;
    }
  }
}

// Computes the cost from the views on the side with the smallest differences. If a surface hides a
// pixel from the views on one side, the views on the opposite side see the pixel.
//
// `differences` contains the differences of rings * arms views: for each ring, the arms in the
// order of their angles. There are 4 or 8 arms, and 1 or 2 rings. A side consists of two adjacent
// arms out of 4, or of three adjacent arms out of 8. The cost is the mean over the views of the
// side times kCostScale, rounded down. The computation uses 171 / 256 in place of 2 / 3.
STARFOCUS_REFERENCE void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings,
                                   size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    int arm[8] = {};
    for (size_t k = 0; k < arms * rings; ++k) arm[k % arms] += differences[k][n];
    int least = INT32_MAX;
    for (size_t k = 0; k < arms; ++k) {
      int side = arm[k] + arm[(k + 1) % arms];
      if (arms == 8) side += arm[(k + 2) % arms];
      least = side < least ? side : least;
    }
    // Factor that converts the sum over the two or three views of a side to the equivalent sum over
    // six views.
    const int scale = arms == 4 ? 3 : 2;
    cost[n] = static_cast<uint8_t>((least * (rings == 1 ? scale : 1) * 171) >> 8);
  }
}

// Sets cost[n] to the mean difference over all views times kCostScale, rounded down. `views` is 4,
// 8 or 16.
STARFOCUS_REFERENCE void MeanCost(const uint8_t* const* differences, size_t views, size_t count,
                                  uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    size_t sum = 0;
    for (size_t k = 0; k < views; ++k) sum += differences[k][n];
    cost[n] = static_cast<uint8_t>(sum * kCostScale / views);
  }
}

// Computes the cost from the side with the smallest mean difference. The mean of a side includes
// only the views of the side that see the pixel: view k sees pixel n if hidden[k][n] <= label. If
// `hidden` is null, all views see all pixels. The cost is the mean times kCostScale, as the sum
// times MeanFactor. If no view of any side sees a pixel, the difference is kUnknownDifference.
STARFOCUS_REFERENCE void SeenCost(const uint8_t* const* differences, const uint8_t* const* hidden,
                                  uint8_t label, const ViewSides& sides, size_t count,
                                  uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    uint32_t least = UINT32_MAX;
    for (size_t side = 0; side < sides.count; ++side) {
      uint32_t sum = 0, seen = 0;
      for (size_t k = 0; sides.masks[side] >> k != 0; ++k) {
        if ((sides.masks[side] >> k & 1) == 0) continue;
        if (hidden != nullptr && hidden[k][n] > label) continue;
        sum += differences[k][n];
        ++seen;
      }
      if (seen == 0) continue;
      const uint32_t mean = sum * MeanFactor(seen) >> 8;
      least = mean < least ? mean : least;
    }
    constexpr uint32_t kMost = kMostDifference * kCostScale;
    if (least == UINT32_MAX) least = kUnknownDifference * kCostScale;
    cost[n] = static_cast<uint8_t>(least < kMost ? least : kMost);
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_MATCH_H_
