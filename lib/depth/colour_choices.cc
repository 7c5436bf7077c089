// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_choices.h"

#include <initializer_list>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Pixels around a doubtful one that are compared with it: up to this far, every second one.
constexpr int32_t kReach = 16, kStride = 2;
constexpr int32_t kMostDifference = 100;
// Disparities that are compared, one group a pixel wide.
constexpr int32_t kGroups = 1024, kGroupOfZero = kGroups / 2;
// What a pixel's disparity costs, by its doubt: 0 is a ramp, and tells others nothing; 1 to 3 lie
// as near to a step as steps are displaced.
constexpr int16_t kNoDisparity = INT16_MAX;
constexpr int16_t kDoubtCosts[kDoubtReach + 2] = {80, 45, 45, 45, 22, 11, 0};
// A step to another surface costs this between pixels of one colour, half of it where colours
// differ by the second number.
constexpr int32_t kJump = 120, kColourEdge = 12;

// Of each group that occurs what costs least, and its disparity.
struct Groups {
  int32_t first, last;
  int16_t cost[kGroups], disparity[kGroups];

  static int32_t Of(int32_t disparity) { return (disparity >> kDisparityBits) + kGroupOfZero; }
  void Offer(int32_t d, int32_t price) {
    const int32_t group = Of(d);
    if (price > cost[group] || (price == cost[group] && d <= disparity[group])) return;
    cost[group] = static_cast<int16_t>(price);
    disparity[group] = static_cast<int16_t>(d);
  }
  int32_t CostAt(int32_t group) const {
    return group < first || group > last ? kNoDisparity : cost[group];
  }
};

// Puts a choice where it belongs by cost; of those that cost as much the nearest comes first.
void Insert(int32_t disparity, int32_t cost, Choices* choices) {
  int32_t at = Min(choices->count, kMostChoices - 1);
  const bool full = choices->count == kMostChoices;
  if (full && choices->cost[at] <= cost) return;
  for (; at > 0 && choices->cost[at - 1] > cost; --at) {
    choices->disparity[at] = choices->disparity[at - 1];
    choices->cost[at] = choices->cost[at - 1];
  }
  choices->disparity[at] = static_cast<int16_t>(disparity);
  choices->cost[at] = static_cast<int16_t>(cost);
  choices->count += full ? 0 : 1;
}

// Takes the groups that cost less than their neighbours do, from the nearest to the farthest.
void TakeBest(const Groups& groups, Choices* choices) {
  choices->count = 0;
  for (int32_t group = groups.last; group >= groups.first; --group) {
    const int32_t cost = groups.cost[group];
    if (cost == kNoDisparity || cost > groups.CostAt(group + 1)) continue;
    if (cost < groups.CostAt(group - 1)) Insert(groups.disparity[group], cost, choices);
  }
}

// Makes sure that the map's disparity, or one nearly as high, is among the choices.
void KeepOwn(int32_t own, int32_t cost, Choices* choices) {
  for (int32_t k = 0; k < choices->count; ++k) {
    if (Abs(choices->disparity[k] - own) <= kPixel) return;
  }
  const int32_t at = choices->count < kMostChoices ? choices->count++ : kMostChoices - 1;
  choices->disparity[at] = static_cast<int16_t>(own);
  choices->cost[at] = static_cast<int16_t>(cost);
}

void CollectChoices(const ColourMap& map, const uint8_t* doubt, int32_t x, int32_t y,
                    Groups* groups, Choices* choices) {
  for (int32_t k = groups->first; k <= groups->last; ++k) {
    groups->cost[k] = kNoDisparity;
    groups->disparity[k] = INT16_MIN;
  }
  const uint8_t* colour = map.Pixel(x, y);
  const int32_t left = x - Min(x, kReach) / kStride * kStride;
  const int32_t top = y - Min(y, kReach) / kStride * kStride;
  const int32_t right = Min(map.plan.width - 1, x + kReach);
  const int32_t bottom = Min(map.plan.height - 1, y + kReach);
  for (int32_t row = top; row <= bottom; row += kStride) {
    const uint8_t* colours = map.Pixel(0, row);
    const uint8_t* doubts = doubt + map.At(0, row);
    const int16_t* disparities = map.disparity + map.At(0, row);
    for (int32_t column = left; column <= right; column += kStride) {
      if (doubts[column] == 0) continue;
      const int32_t difference =
          Min(kMostDifference, ColourDifference(colour, colours + 3 * column));
      groups->Offer(disparities[column], difference + kDoubtCosts[doubts[column]]);
    }
  }
  TakeBest(*groups, choices);
  const size_t own = map.At(x, y);
  KeepOwn(map.disparity[own], kDoubtCosts[doubt[own]], choices);
}

// Goes on along a path: from a pixel's choices, with the costs up to it, to those of the next one.
// `jump` is what another surface costs. Adds the costs to the sums.
void Continue(const Choices& from, const ChoicePath& before, int32_t jump, Choices* to,
              ChoicePath* path) {
  int32_t least = before.cost[0];
  for (int32_t k = 1; k < from.count; ++k) least = Min(least, before.cost[k]);
  ChoicePath next;
  for (int32_t k = 0; k < to->count; ++k) {
    int32_t cost = least + jump;
    for (int32_t other = 0; other < from.count; ++other) {
      const int32_t difference = Abs(to->disparity[k] - from.disparity[other]);
      if (difference > 3 * kPixel) continue;
      cost = Min(cost, before.cost[other] + (difference > kPixel ? jump / 2 : 0));
    }
    next.cost[k] = static_cast<int16_t>(to->cost[k] + cost - least);
    to->sum[k] = static_cast<int16_t>(to->sum[k] + next.cost[k]);
  }
  *path = next;
}

void Begin(Choices* choices, ChoicePath* path) {
  for (int32_t k = 0; k < choices->count; ++k) {
    path->cost[k] = choices->cost[k];
    choices->sum[k] = static_cast<int16_t>(choices->sum[k] + choices->cost[k]);
  }
}

int32_t JumpBetween(const uint8_t* a, const uint8_t* b) {
  return kJump * kColourEdge / (kColourEdge + ColourDifference(a, b));
}

// Adds the paths along rows, to the right (direction 1) or to the left (-1).
void AddPathsAcross(const ColourMap& map, const Rect& region, int32_t direction, Choices* choices) {
  for (int32_t y = 0; y < region.height; ++y) {
    Choices* row = choices + static_cast<size_t>(y) * static_cast<size_t>(region.width);
    int32_t x = direction > 0 ? 0 : region.width - 1;
    ChoicePath path;
    Begin(row + x, &path);
    for (int32_t k = 1; k < region.width; ++k, x += direction) {
      const uint8_t* colour = map.Pixel(region.x + x, region.y + y);
      Continue(row[x], path, JumpBetween(colour, colour + 3 * direction), row + x + direction,
               &path);
    }
  }
}

// Adds the paths along columns, down (direction 1) or up (-1).
void AddPathsDown(const ColourMap& map, const Rect& region, int32_t direction, ChoicePath* paths,
                  Choices* choices) {
  const auto width = static_cast<size_t>(region.width);
  int32_t y = direction > 0 ? 0 : region.height - 1;
  for (size_t x = 0; x < width; ++x) {
    Begin(choices + static_cast<size_t>(y) * width + x, paths + x);
  }
  for (int32_t k = 1; k < region.height; ++k, y += direction) {
    const Choices* from = choices + static_cast<size_t>(y) * width;
    Choices* to = choices + static_cast<size_t>(y + direction) * width;
    const uint8_t* colour = map.Pixel(region.x, region.y + y);
    const uint8_t* next = map.Pixel(region.x, region.y + y + direction);
    for (size_t x = 0; x < width; ++x) {
      Continue(from[x], paths[x], JumpBetween(colour + 3 * x, next + 3 * x), to + x, paths + x);
    }
  }
}

// Finds which groups occur within reach of the region.
void FindGroups(const ColourMap& map, const Rect& region, Groups* groups) {
  const Rect around = Widened(map.plan, region, kReach);
  int32_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int16_t* row = map.disparity + map.At(around.x, y);
    for (int32_t x = 0; x < around.width; ++x) {
      low = Min(low, row[x]);
      high = Max(high, row[x]);
    }
  }
  groups->first = Groups::Of(low);
  groups->last = Groups::Of(high);
}

}  // namespace

void WeighChoices(const ColourMap& map, const uint8_t* doubt, const Rect& region, ChoicePath* paths,
                  Choices* choices) {
  Groups groups;
  FindGroups(map, region, &groups);
  Choices* next = choices;
  for (int32_t y = region.y; y < region.y + region.height; ++y) {
    for (int32_t x = region.x; x < region.x + region.width; ++x, ++next) {
      const size_t at = map.At(x, y);
      if (doubt[at] <= kDoubtReach) {
        CollectChoices(map, doubt, x, y, &groups, next);
      } else {
        next->count = 1;
        next->disparity[0] = map.disparity[at];
        next->cost[0] = 0;
      }
      for (int32_t k = 0; k < next->count; ++k) next->sum[k] = 0;
    }
  }
  for (const int32_t direction : {1, -1}) {
    AddPathsAcross(map, region, direction, choices);
    AddPathsDown(map, region, direction, paths, choices);
  }
}

}  // namespace starfocus
