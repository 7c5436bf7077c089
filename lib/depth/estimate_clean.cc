// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_clean.h"

#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"

namespace starfocus {
namespace {

constexpr int32_t kRadius = 2;
constexpr int32_t kMostVotes = (2 * kRadius + 1) * (2 * kRadius + 1);
// A pixel is stray if its disparity differs from the weighted median of its neighbourhood by more
// than kStray (kDisparityBits). Pixels that are not stray keep their disparity, so that slopes are
// preserved. A neighbour of equal colour has the weight kVote. The weight halves with each kHalving
// grey levels of difference, summed over R, G and B.
constexpr int32_t kStray = 1 << (kDisparityBits - 2);
constexpr int32_t kVote = 64, kHalving = 14;

// Disparities with weights. Unused elements have weight 0.
struct Votes {
  static constexpr int32_t kPlaces = (kMostVotes + 7) / 8 * 8;  // whole vectors

  int32_t count = 0, weight = 0;
  int16_t disparity[kPlaces] = {};
  int16_t of[kPlaces] = {};

  void Add(int16_t d, int32_t vote) {
    disparity[count] = d;
    of[count++] = static_cast<int16_t>(vote);
    weight += vote;
  }

  // Returns the smallest disparity d in [low, high] for which disparities above d have at most half
  // of the total weight.
  int16_t Median(int32_t low, int32_t high) const {
    while (low < high) {
      const int32_t middle = (low + high) >> 1;
      const auto most = static_cast<int16_t>(middle);
      int16_t below = 0;
      for (int32_t k = 0; k < kPlaces; ++k) {
        below = static_cast<int16_t>(below + (disparity[k] <= most ? of[k] : int16_t{0}));
      }
      if (2 * below < weight) {
        low = middle + 1;
      } else {
        high = middle;
      }
    }
    return static_cast<int16_t>(low);
  }
};

int32_t Apart(const uint8_t* a, const uint8_t* b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

struct AroundRange {
  int32_t low, high;
};

// Returns the range of the disparities in the rectangle `around`.
AroundRange RangeOf(const EstimatePlan& plan, const int16_t* map, const Rect& around) {
  AroundRange range = {INT16_MAX, INT16_MIN};
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* disparity = map + static_cast<size_t>(row) * static_cast<size_t>(plan.width);
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      range.low = Min(range.low, disparity[column]);
      range.high = Max(range.high, disparity[column]);
    }
  }
  return range;
}

}  // namespace

int16_t WithoutStray(const EstimatePlan& plan, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y) {
  const Rect around = Widened(plan, {x, y, 1, 1}, kRadius);
  const int16_t own =
      map[static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x)];
  const AroundRange range = RangeOf(plan, map, around);
  // If all disparities in the neighbourhood are within kStray of the pixel's disparity, their
  // median is within kStray.
  if (range.low >= own - kStray && range.high <= own + kStray) return own;
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
  const int16_t median = votes.Median(range.low, range.high);
  return std::abs(own - median) > kStray ? median : own;
}

}  // namespace starfocus
