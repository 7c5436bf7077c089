// SPDX-License-Identifier: Apache-2.0
#include "simd/match.h"

namespace starfocus::simd::reference {
namespace {

int Between(int a, int b, int part) { return (a * (128 - part) + b * part + 64) >> 7; }

}  // namespace

void MatchView(const MatchRow& row, size_t count, uint8_t* difference) {
  for (size_t n = 0; n < count; ++n) {
    int sum = 0;
    for (int c = 0; c < 3; ++c) {
      const uint8_t* above = row.view[c] + n;
      const uint8_t* below = above + row.view_stride;
      const int left = Between(above[0], below[0], row.down);
      const int right = Between(above[1], below[1], row.down);
      const int apart = Between(left, right, row.across) - row.centre[c][n];
      sum += apart < 0 ? -apart : apart;
    }
    difference[n] = static_cast<uint8_t>(sum < kMostDifference ? sum : kMostDifference);
  }
}

void StandIn(const int16_t* highest_a, const int16_t* highest_b, int16_t limit, size_t count,
             uint8_t* a, uint8_t* b) {
  for (size_t n = 0; n < count; ++n) {
    const bool by_a = highest_a[n] <= limit, by_b = highest_b[n] <= limit;
    const uint8_t of_a = a[n], of_b = b[n];
    a[n] = by_a ? of_a : by_b ? of_b : uint8_t{kUnknownDifference};
    b[n] = by_b ? of_b : by_a ? of_a : uint8_t{kUnknownDifference};
  }
}

void LimitHidden(const int16_t* const* highest, int16_t limit, size_t views, size_t count,
                 uint8_t* const* differences) {
  for (size_t n = 0; n < count; ++n) {
    bool seen = false;
    for (size_t k = 0; k < views; ++k) seen = seen || highest[k][n] <= limit;
    const uint8_t most = seen ? kHiddenDifference : kUnseenDifference;
    for (size_t k = 0; k < views; ++k) {
      uint8_t& difference = differences[k][n];
      if (highest[k][n] > limit && difference > most) difference = most;
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
    const int scale = arms == 4 ? 3 : 2;  // to six views
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

void GatherLabels(const uint8_t* rows, size_t row_stride, size_t count, uint8_t* pixels,
                  size_t pixel_stride) {
  for (size_t n = 0; n < count; ++n) {
    for (size_t k = 0; k < kSliceLanes; ++k)
      pixels[n * pixel_stride + k] = rows[k * row_stride + n];
  }
}

}  // namespace starfocus::simd::reference
