// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_clean.h"

#include <cstdlib>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kRadius = 2;
constexpr int32_t kMostVotes = (2 * kRadius + 1) * (2 * kRadius + 1);
// The weight of a pixel of the same colour; it halves with each kHalving gray levels, of all three
// colours together, that a pixel differs by.
// A pixel further from the median than this is wrong, kDisparityBits; others keep what slopes them.
constexpr int32_t kStray = 1 << (kDisparityBits - 2);
constexpr int32_t kVote = 64, kHalving = 14;

struct Votes {
  int32_t count = 0, weight = 0;
  int16_t disparity[kMostVotes];  // ascending
  int16_t of[kMostVotes];         // their weights

  void Add(int16_t d, int32_t vote) {
    int32_t at = count++;
    for (; at > 0 && disparity[at - 1] > d; --at) {
      disparity[at] = disparity[at - 1];
      of[at] = of[at - 1];
    }
    disparity[at] = d;
    of[at] = static_cast<int16_t>(vote);
    weight += vote;
  }

  int16_t Median() const {
    int32_t below = 0, at = 0;
    while (2 * (below + of[at]) < weight) below += of[at++];
    return disparity[at];
  }
};

int32_t Apart(const uint8_t* a, const uint8_t* b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

// Whether no disparity around a pixel differs from its own by more than kStray: their median can't
// either.
bool IsSmooth(const EstimatePlan& plan, const int16_t* map, const Rect& around, int32_t own) {
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* disparity = map + static_cast<size_t>(row) * static_cast<size_t>(plan.width);
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      if (std::abs(disparity[column] - own) > kStray) return false;
    }
  }
  return true;
}

}  // namespace

int16_t WithoutStray(const EstimatePlan& plan, const sf_plane& centre, const int16_t* map,
                     int32_t x, int32_t y) {
  const Rect around = Widened(plan, {x, y, 1, 1}, kRadius);
  const int16_t own =
      map[static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x)];
  if (IsSmooth(plan, map, around, own)) return own;
  const uint8_t* here = centre.data + static_cast<size_t>(y) * centre.stride + 3 * x;
  Votes votes;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const uint8_t* rgb = centre.data + static_cast<size_t>(row) * centre.stride;
    const int16_t* disparity = map + static_cast<size_t>(row) * static_cast<size_t>(plan.width);
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const int32_t halvings = Apart(here, rgb + 3 * column) / kHalving;
      const int32_t vote = halvings < 7 ? kVote >> halvings : 0;
      if (vote > 0) votes.Add(disparity[column], vote);
    }
  }
  const int16_t median = votes.Median();
  return std::abs(own - median) > kStray ? median : own;
}

}  // namespace starfocus
