// SPDX-License-Identifier: Apache-2.0
#include "simd/match.h"

namespace starfocus::simd::reference {

void MatchView(const uint8_t* centre, const uint8_t* view, size_t plane, size_t count,
               uint8_t* difference) {
  for (size_t n = 0; n < count; ++n) {
    int sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const int apart = view[n + c * plane] - centre[n + c * plane];
      sum += apart < 0 ? -apart : apart;
    }
    difference[n] = static_cast<uint8_t>(sum < kMostDifference ? sum : kMostDifference);
  }
}

void StandIn(const uint8_t* hidden_a, const uint8_t* hidden_b, uint8_t label, size_t count,
             uint8_t* a, uint8_t* b) {
  for (size_t n = 0; n < count; ++n) {
    const bool by_a = hidden_a[n] <= label, by_b = hidden_b[n] <= label;
    const uint8_t of_a = a[n], of_b = b[n];
    a[n] = by_a ? of_a : by_b ? of_b : uint8_t{kUnknownDifference};
    b[n] = by_b ? of_b : by_a ? of_a : uint8_t{kUnknownDifference};
  }
}

void LimitHidden(const uint8_t* const* hidden, uint8_t label, size_t views, size_t count,
                 uint8_t* const* differences) {
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

void LeastSide(const uint8_t* const* differences, size_t arms, size_t rings, size_t count,
               uint8_t* cost) {
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

void MeanCost(const uint8_t* const* differences, size_t views, size_t count, uint8_t* cost) {
  for (size_t n = 0; n < count; ++n) {
    size_t sum = 0;
    for (size_t k = 0; k < views; ++k) sum += differences[k][n];
    cost[n] = static_cast<uint8_t>(sum * kCostScale / views);
  }
}

void SeenCost(const uint8_t* const* differences, const uint8_t* const* hidden, uint8_t label,
              const ViewSides& sides, size_t count, uint8_t* cost) {
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

}  // namespace starfocus::simd::reference
