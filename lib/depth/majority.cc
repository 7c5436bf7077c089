// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/majority.h"

namespace starfocus {
namespace {

constexpr int32_t kRadius = 5;
// A pixel counts less with its squared distance, and with how its colour differs.
constexpr int32_t kNearWeight = 36, kColourWeight = 64;

// The disparities around a pixel.
struct Range {
  int32_t low, high;
};

Range RangeAround(const ColourMap& map, const Rect& rect) {
  const Rect around = Widened(map.plan, rect, kRadius);
  Range range = {INT16_MAX, INT16_MIN};
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int16_t* row = map.disparity + map.At(around.x, y);
    for (int32_t x = 0; x < around.width; ++x) {
      range.low = Min(range.low, row[x]);
      range.high = Max(range.high, row[x]);
    }
  }
  return range;
}

bool IsOneSurface(const Range& range) { return range.high - range.low <= 2 * kSurfaceStep; }

}  // namespace

bool IsOneSurface(const ColourMap& map, const Rect& rect) {
  return IsOneSurface(RangeAround(map, rect));
}

int16_t MajorityAt(const ColourMap& map, int32_t x, int32_t y) {
  const int32_t own = map.disparity[map.At(x, y)];
  const Rect around = Widened(map.plan, {x, y, 1, 1}, kRadius);
  const Range range = RangeAround(map, {x, y, 1, 1});
  if (IsOneSurface(range)) return static_cast<int16_t>(own);
  const int32_t middle = (range.low + range.high) / 2;
  const uint8_t* colour = map.Pixel(x, y);
  int64_t sums[2] = {};
  int32_t votes[2] = {};
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const int32_t dx = column - x, dy = row - y;
      if (dx * dx + dy * dy > kRadius * kRadius) continue;
      const int32_t difference = ColourDifference(colour, map.Pixel(column, row));
      const int32_t weight = (kNearWeight - dx * dx - dy * dy) * Max(1, kColourWeight - difference);
      const int32_t disparity = map.disparity[map.At(column, row)];
      const int side = disparity > middle ? 1 : 0;
      votes[side] += weight;
      sums[side] += int64_t{weight} * disparity;
    }
  }
  const int own_side = own > middle ? 1 : 0, other = 1 - own_side;
  if (votes[other] <= votes[own_side]) return static_cast<int16_t>(own);
  return static_cast<int16_t>(sums[other] / votes[other]);
}

}  // namespace starfocus
