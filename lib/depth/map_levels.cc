// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/map_levels.h"

#include <algorithm>
#include <cmath>

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Half of the widest ramp whose ends are found.
constexpr int32_t kRampReach = 12;
// Smallest step that is an edge.
constexpr int32_t kLeastStep = 4 * kPixel;
// Pixels of one surface differ by at most this from their neighbours.
constexpr int32_t kFlat = kPixel / 2;
// Of 25 pixels around a corner of a step this many are as high as the corner; on a ramp 5 are.
constexpr int32_t kLeastSame = 8;
// Steps of a distance: to a pixel beside, and to one diagonally.
constexpr int32_t kBeside = 3, kDiagonal = 4;
// A key holds a distance in its upper half and 16 bits of a level in its lower half.
constexpr int32_t kKeyBits = 16;
constexpr int32_t kFarAway = 0x3FFF << kKeyBits;

struct Region {
  Rect rect;
  size_t stride;  // of the windows

  size_t width() const { return static_cast<size_t>(rect.width); }
  size_t height() const { return static_cast<size_t>(rect.height); }
};

// Extends every sample of a plane of `count` samples by those up to 2 * kRampReach behind it,
// `step` samples apart.
template <class Better>
void Extend(size_t count, size_t step, const Better& better, int16_t* plane) {
  const auto widen = [&](size_t by) {
    const size_t shift = by * step;
    for (size_t k = 0; k + shift < count; ++k) plane[k] = better(plane[k], plane[k + shift]);
  };
  for (const size_t by : {1, 2, 4, 8, 9}) widen(by);
}

// Fills a window plane of the region with the best value within kRampReach.
template <class Better>
void FindBest(const ColourMap& map, const Region& region, int16_t neutral, const Better& better,
              int16_t* plane) {
  const size_t rows = region.height() + 2 * kRampReach;
  std::fill_n(plane, rows * region.stride, neutral);
  for (size_t y = 0; y < region.height(); ++y) {
    const int16_t* from = map.disparity + map.At(region.rect.x, region.rect.y) +
                          y * static_cast<size_t>(map.plan.width);
    std::copy_n(from, region.width(), plane + (y + kRampReach) * region.stride + kRampReach);
  }
  Extend(rows * region.stride, 1, better, plane);
  Extend(rows * region.stride, region.stride, better, plane);
}

// What the pixels around say of one.
enum class Shape { kLevel, kBesideStep, kSlope };

Shape ShapeAt(const ColourMap& map, int32_t x, int32_t y) {
  const auto width = static_cast<ptrdiff_t>(map.plan.width);
  const int16_t* at = map.disparity + map.At(x, y);
  const ptrdiff_t left = x > 0 ? -1 : 0, right = x + 1 < map.plan.width ? 1 : 0;
  const ptrdiff_t up = y > 0 ? -width : 0, down = y + 1 < map.plan.height ? width : 0;
  int32_t low = *at, high = *at;
  for (const ptrdiff_t row : {up, ptrdiff_t{0}, down}) {
    for (const ptrdiff_t column : {left, ptrdiff_t{0}, right}) {
      low = Min(low, at[row + column]);
      high = Max(high, at[row + column]);
    }
  }
  if (high - low <= kFlat) return Shape::kLevel;
  return Max(high - *at, *at - low) > kSurfaceStep ? Shape::kBesideStep : Shape::kSlope;
}

// Returns whether enough of the pixels around are as high as the one at (x, y). On a ramp few are,
// at a corner of a step and on a thin surface these are.
bool IsOnSurface(const ColourMap& map, int32_t x, int32_t y) {
  const Rect around = Widened(map.plan, {x, y, 1, 1}, 2);
  const int32_t own = map.disparity[map.At(x, y)];
  int32_t same = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* line = map.disparity + map.At(around.x, row);
    for (int32_t k = 0; k < around.width; ++k) same += Abs(line[k] - own) <= kFlat ? 1 : 0;
  }
  return 25 * same >= kLeastSame * around.width * around.height;
}

// Carries keys to the pixels that come later in a scan of the region, or earlier.
void Carry(const Region& region, bool forwards, int32_t* keys) {
  const int32_t width = region.rect.width, height = region.rect.height;
  constexpr int32_t kOn = kBeside << kKeyBits, kAcross = kDiagonal << kKeyBits;
  const int32_t step = forwards ? 1 : -1;
  for (int32_t k = 0; k < height; ++k) {
    int32_t* row = keys + static_cast<ptrdiff_t>(forwards ? k : height - 1 - k) * width;
    if (k > 0) {
      const int32_t* before = row - static_cast<ptrdiff_t>(step) * width;
      for (int32_t x = 0; x < width; ++x) row[x] = Min(row[x], before[x] + kOn);
      for (int32_t x = 1; x < width; ++x) row[x] = Min(row[x], before[x - 1] + kAcross);
      for (int32_t x = 0; x + 1 < width; ++x) row[x] = Min(row[x], before[x + 1] + kAcross);
    }
    for (int32_t n = 1, x = forwards ? 1 : width - 2; n < width; ++n, x += step) {
      row[x] = Min(row[x], row[x - step] + kOn);
    }
  }
}

int32_t KeyOfNear(int32_t level) { return INT16_MAX - level; }
int32_t KeyOfFar(int32_t level) { return level - INT16_MIN; }
int32_t LevelBits(int32_t key) { return key & ((1 << kKeyBits) - 1); }

// Enters the seeds of the region: flat pixels at the ends of ramps, and the pixels of ramps.
// Returns whether there is an edge.
bool EnterSeeds(const ColourMap& map, const Region& region, const LevelsScratch& scratch) {
  bool any = false;
  size_t k = 0;
  for (int32_t row = 0; row < region.rect.height; ++row) {
    const size_t window = static_cast<size_t>(row) * region.stride;
    for (int32_t column = 0; column < region.rect.width; ++column, ++k) {
      for (int32_t* keys : scratch.keys) keys[k] = kFarAway;
      const int32_t high = scratch.high[window + static_cast<size_t>(column)];
      const int32_t low = scratch.low[window + static_cast<size_t>(column)];
      if (high - low <= kLeastStep) continue;
      const int32_t x = region.rect.x + column, y = region.rect.y + row;
      const int32_t own = map.disparity[map.At(x, y)];
      if (!std::isfinite(GivenAt(map.light_field, y)[x])) {
        scratch.keys[2][k] = 0;
        continue;
      }
      const Shape own_shape = ShapeAt(map, x, y);
      if (own_shape != Shape::kLevel) {
        scratch.keys[2][k] = 0;
        any = true;
        if (own_shape == Shape::kSlope || !IsOnSurface(map, x, y)) continue;
      }
      if (2 * own > high + low) {
        scratch.keys[0][k] = KeyOfNear(own);
      } else {
        scratch.keys[1][k] = KeyOfFar(own);
      }
    }
  }
  return any;
}

// Writes what the keys say of a pixel.
void WritePlace(const ColourMap& map, const Region& region, const LevelsScratch& scratch, int32_t x,
                int32_t y, const MapLevels& levels) {
  const int32_t column = x - region.rect.x, row = y - region.rect.y;
  const size_t k = static_cast<size_t>(row) * region.width() + static_cast<size_t>(column);
  const size_t at = map.At(x, y);
  const int32_t distance = (scratch.keys[2][k] >> kKeyBits) / kBeside;
  levels.place[at] = kNoEdge;
  const int32_t front = scratch.keys[0][k], back = scratch.keys[1][k];
  if (distance > kMostDistance || front >= kFarAway || back >= kFarAway) return;
  int32_t near_level = INT16_MAX - LevelBits(front), far_level = LevelBits(back) + INT16_MIN;
  if (near_level - far_level <= kSurfaceStep) return;
  const size_t window = static_cast<size_t>(row) * region.stride + static_cast<size_t>(column);
  const int32_t high = scratch.high[window], low = scratch.low[window];
  const int32_t own = map.disparity[at];
  const bool near_side = high - low > kLeastStep ? 2 * own > high + low : front < back;
  if (distance > 0) (near_side ? near_level : far_level) = own;
  levels.near_level[at] = static_cast<int16_t>(near_level);
  levels.far_level[at] = static_cast<int16_t>(far_level);
  const bool on_ramp = distance == 0 && front >> kKeyBits > 0 && back >> kKeyBits > 0;
  levels.place[at] =
      static_cast<uint8_t>(distance | (near_side ? kNearSide : 0) | (on_ramp ? kOnRamp : 0));
}

}  // namespace

LevelsScratch TakeLevelsScratch(size_t width, size_t height, Carver* carver) {
  LevelsScratch scratch;
  const size_t across = width + 2 * kRampReach, down = height + 2 * kRampReach;
  scratch.high = carver->Take<int16_t>(across, down);
  scratch.low = carver->Take<int16_t>(across, down);
  for (int32_t*& keys : scratch.keys) keys = carver->Take<int32_t>(width, height);
  return scratch;
}

void FindLevels(const ColourMap& map, const Rect& tile, const LevelsScratch& scratch,
                const MapLevels& levels) {
  Region region = {Widened(map.plan, tile, kLevelsMargin), 0};
  region.stride = region.width() + 2 * kRampReach;
  const auto most = [](int16_t a, int16_t b) { return a > b ? a : b; };
  const auto least = [](int16_t a, int16_t b) { return a < b ? a : b; };
  FindBest(map, region, INT16_MIN, most, scratch.high);
  FindBest(map, region, INT16_MAX, least, scratch.low);
  const bool any = EnterSeeds(map, region, scratch);
  for (int32_t* keys : scratch.keys) {
    for (const bool forwards : {true, false}) {
      if (any) Carry(region, forwards, keys);
    }
  }
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    if (!any) {
      std::fill_n(levels.place + map.At(tile.x, y), tile.width, kNoEdge);
      continue;
    }
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      WritePlace(map, region, scratch, x, y, levels);
    }
  }
}

}  // namespace starfocus
