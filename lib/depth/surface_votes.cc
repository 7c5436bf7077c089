// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/surface_votes.h"

namespace starfocus {
namespace {

// Pixels around that are compared: up to this far, every fourth one.
constexpr int32_t kReach = 16, kStride = 4;
constexpr int32_t kMostDifference = 100;
// What a compared pixel costs by its distance from a ramp. Steps are displaced by up to three
// pixels. Pixels on a ramp are not compared.
constexpr int32_t kDistances = 6;
constexpr int32_t kDistanceCosts[kDistances + 1] = {45, 45, 45, 45, 22, 11, 0}, kRampCost = 80;
// What another pixel costs more than the map's own disparity.
constexpr int32_t kOtherCost = 0;
// A pixel of the same colour has this weight in a mean of votes.
constexpr int32_t kMostWeight = 64;
// Mean vote from which on one surface covers the pixel alone.
constexpr int32_t kFullVote = 24;

int32_t CostAt(const MapLevels& levels, size_t at) {
  if ((levels.place[at] & kOnRamp) != 0) return kRampCost;
  return kDistanceCosts[Min(levels.place[at] & kDistanceMask, kDistances)];
}

}  // namespace

Likeness CompareAround(const ColourMap& map, const MapLevels& levels, int32_t x, int32_t y) {
  const size_t own = map.At(x, y);
  const int32_t middle = (levels.near_level[own] + levels.far_level[own]) / 2;
  const uint8_t* colour = map.Pixel(x, y);
  const int32_t left = x - Min(x, kReach) / kStride * kStride;
  const int32_t top = y - Min(y, kReach) / kStride * kStride;
  const int32_t right = Min(map.plan.width - 1, x + kReach);
  const int32_t bottom = Min(map.plan.height - 1, y + kReach);
  Likeness best = {{kMostDifference, kMostDifference},
                   {levels.far_level[own], levels.near_level[own]}};
  const int32_t own_side = (levels.place[own] & kNearSide) != 0 ? 1 : 0;
  best.costs[own_side] = CostAt(levels, own);
  for (int32_t row = top; row <= bottom; row += kStride) {
    const uint8_t* colours = map.Pixel(0, row);
    const size_t line = map.At(0, row);
    for (int32_t column = left; column <= right; column += kStride) {
      const size_t at = line + static_cast<size_t>(column);
      if ((levels.place[at] & kOnRamp) != 0) continue;
      const int32_t cost =
          ColourDifference(colour, colours + 3 * column) + CostAt(levels, at) + kOtherCost;
      const int32_t side = map.disparity[at] > middle ? 1 : 0;
      // Nearest of two pixels that cost as much, so that mirrored pictures have mirrored maps.
      if (cost > best.costs[side]) continue;
      if (cost == best.costs[side] && map.disparity[at] <= best.disparities[side]) continue;
      best.costs[side] = cost;
      best.disparities[side] = map.disparity[at];
    }
  }
  return best;
}

int32_t CoverageByVotes(const ColourMap& map, const Rect& rect, const int8_t* votes, int32_t x,
                        int32_t y) {
  constexpr int32_t kStep = 2;
  const int32_t left = x - Min(x, kVoteRadius) / kStep * kStep;
  const int32_t top = y - Min(y, kVoteRadius) / kStep * kStep;
  const int32_t right = Min(map.plan.width - 1, x + kVoteRadius);
  const int32_t bottom = Min(map.plan.height - 1, y + kVoteRadius);
  const uint8_t* colour = map.Pixel(x, y);
  int32_t sum = 0, weights = 0;
  for (int32_t row = top; row <= bottom; row += kStep) {
    const int8_t* line = votes + static_cast<ptrdiff_t>(row - rect.y) * rect.width - rect.x;
    const uint8_t* colours = map.Pixel(0, row);
    for (int32_t column = left; column <= right; column += kStep) {
      const int32_t difference = ColourDifference(colour, colours + 3 * column);
      const int32_t weight = Max(1, kMostWeight - 2 * difference);
      sum += weight * line[column];
      weights += weight;
    }
  }
  return Clamp((255 * (sum + kFullVote * weights)) / (2 * kFullVote * weights), 0, 255);
}

}  // namespace starfocus
