// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
constexpr int16_t kUnknown = INT16_MIN;
// Largest difference of disparity between a pixel and a neighbour that counts as flat, in fixed
// point (kDisparityBits). At blurred edges, the disparities of neighbours differ by more than
// kFlat.
constexpr int32_t kFlat = kPixel / 2;
// Smallest number of flat pixels among the 5x5 pixels around a pixel that is not on a ramp. At
// the corner of a surface, at least 8 of the 25 pixels are flat; on a ramp, at most 5 are.
constexpr int32_t kLeastFlat = 8;
constexpr int32_t kFlatRadius = 2;
// Width and height in pixels of the cells that are tested for flatness as a whole. Most cells are
// flat, so testing whole cells saves time.
constexpr int32_t kFlatCell = 4;
// Largest standard deviation of noise that is invisible in a refocused picture, in fixed point
// (kDisparityBits).
constexpr int32_t kLeastNoise = 6;

// Fills the unknown pixels of a row. Returns false if no pixel of the row is known.
bool FillRow(int32_t width, int16_t* row) {
  int32_t last = -1;
  for (int32_t x = 0; x <= width; ++x) {
    if (x < width && row[x] == kUnknown) continue;
    if (x == width && last < 0) return false;
    for (int32_t k = last + 1; k < x; ++k) {
      const int32_t before = k - last, after = x - k;
      const bool left =
          last >= 0 && (x == width || before < after || (before == after && row[last] < row[x]));
      row[k] = left ? row[last] : row[x];
    }
    last = x;
  }
  return true;
}

// Fills the unknown rows [first, end), which lie between two known rows, or between a known row and
// the top or bottom of the map.
void FillRows(const EstimatePlan& plan, int32_t first, int32_t end, int16_t* map) {
  const auto width = static_cast<size_t>(plan.width);
  // If the unknown rows touch the top or bottom of the map, the pointer on that side is invalid and
  // is not read.
  const int16_t* above = map + static_cast<size_t>(Max(first - 1, 0)) * width;
  const int16_t* below = map + static_cast<size_t>(Min(end, plan.height - 1)) * width;
  for (int32_t y = first; y < end; ++y) {
    const int32_t before = first == 0 ? INT32_MAX : y - first + 1;
    const int32_t after = end == plan.height ? INT32_MAX : end - y;
    int16_t* row = map + static_cast<size_t>(y) * width;
    if (before != after) {
      std::memcpy(row, before < after ? above : below, width * sizeof(int16_t));
      continue;
    }
    for (size_t x = 0; x < width; ++x) row[x] = above[x] < below[x] ? above[x] : below[x];
  }
}

// Returns the initial doubt of a pixel: 0 for unknown pixels and on ramps, 1 at steps, and
// kDoubtReach + 1 for all other pixels.
uint8_t DoubtAt(const ColourMap& map, int32_t x, int32_t y) {
  if (!std::isfinite(GivenAt(map.light_field, y)[x])) return 0;
  const int32_t own = map.disparity[map.At(x, y)];
  const Rect around = Widened(map.plan, {x, y, 1, 1}, kFlatRadius);
  int32_t flat = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* disparities = map.disparity + map.At(around.x, row);
    for (int32_t k = 0; k < around.width; ++k) flat += Abs(disparities[k] - own) <= kFlat ? 1 : 0;
    if (25 * flat < kLeastFlat * around.width * around.height) continue;
    return IsBesideStep(map, {0, 0, map.plan.width, map.plan.height}, x, y) ? 1 : kDoubtReach + 1;
  }
  return 0;
}

// Returns true if every pixel of a cell is known, and if the cell and its surroundings are flat.
bool IsFlat(const ColourMap& map, const Rect& cell) {
  if (HasStep(map, cell, kFlatRadius, kFlat)) return false;
  for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
    const float* row = GivenAt(map.light_field, y) + cell.x;
    for (int32_t x = 0; x < cell.width; ++x) {
      if (!std::isfinite(row[x])) return false;
    }
  }
  return true;
}

// Fills the initial doubt (DoubtAt) of each pixel of a region.
void FillAlone(const ColourMap& map, const Rect& region, uint8_t* doubt) {
  for (int32_t top = 0; top < region.height; top += kFlatCell) {
    for (int32_t left = 0; left < region.width; left += kFlatCell) {
      const Rect cell = {region.x + left, region.y + top, Min(kFlatCell, region.width - left),
                         Min(kFlatCell, region.height - top)};
      const bool flat = IsFlat(map, cell);
      for (int32_t y = 0; y < cell.height; ++y) {
        uint8_t* row = doubt + (top + y) * region.width + left;
        for (int32_t x = 0; x < cell.width; ++x) {
          row[x] = flat ? uint8_t{kDoubtReach + 1} : DoubtAt(map, cell.x + x, cell.y + y);
        }
      }
    }
  }
}

// Scans the region forwards (direction 1) or backwards (-1) and limits each pixel's doubt to the
// doubt of a previously scanned neighbour plus 1.
void CarryOn(const Rect& region, int32_t direction, uint8_t* doubt) {
  const int32_t width = region.width, height = region.height;
  for (int32_t k = 0; k < height; ++k) {
    uint8_t* row = doubt + (direction > 0 ? k : height - 1 - k) * width;
    const uint8_t* before = k > 0 ? row - direction * width : row;
    for (int32_t x = 0; x < width && k > 0; ++x) {
      const int32_t beside = Min(before[Max(x - 1, 0)], before[Min(x + 1, width - 1)]);
      row[x] = static_cast<uint8_t>(Min(row[x], Min(before[x], beside) + 1));
    }
    int32_t last = UINT8_MAX;
    for (int32_t n = 0; n < width; ++n) {
      uint8_t* at = row + (direction > 0 ? n : width - 1 - n);
      last = Min(*at, last + 1);
      *at = static_cast<uint8_t>(last);
    }
  }
}

// Returns true if pixel (x, y), which is next to a step, belongs to a surface without a core within
// kDisplacement. A core consists of pixels farther than kDisplacement from all steps. A surface
// that the map has widened on all sides has a core within kDisplacement of each of its pixels.
bool IsThin(const ColourMap& map, const Rect& region, const uint8_t* doubt, int32_t x, int32_t y) {
  const int32_t own = map.disparity[map.At(x, y)];
  const Rect around = Widened(map.plan, {x, y, 1, 1}, kDisplacement);
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const uint8_t* doubts = doubt + (row - region.y) * region.width;
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const int32_t difference = Abs(map.disparity[map.At(column, row)] - own);
      if (doubts[column - region.x] > kDisplacement && difference <= kPixel) return false;
    }
  }
  return true;
}

}  // namespace

void ReadMap(const EstimatePlan& plan, const starfocus_light_field& light_field,
             int16_t* disparity) {
  const ColourMap map = {plan, light_field, disparity};
  int32_t unknown = 0;  // number of unknown rows directly above row y, which remain to be filled
  for (int32_t y = 0; y < plan.height; ++y) {
    int16_t* row = disparity + map.At(0, y);
    const float* given = GivenAt(light_field, y);
    for (int32_t x = 0; x < plan.width; ++x) {
      row[x] = std::isfinite(given[x]) ? ToFixed(given[x]) : kUnknown;
    }
    if (!FillRow(plan.width, row)) {
      ++unknown;
      continue;
    }
    FillRows(plan, y - unknown, y, disparity);
    unknown = 0;
  }
  FillRows(plan, plan.height - unknown, plan.height, disparity);
}

int32_t MeasureNoise(const EstimatePlan& plan, const int16_t* disparity) {
  constexpr int32_t kMost = 1023;  // counts[kMost] includes all larger values
  uint32_t counts[kMost + 1] = {};
  const auto width = static_cast<size_t>(plan.width), height = static_cast<size_t>(plan.height);
  size_t total = 0;
  for (size_t y = 1; y + 1 < height; ++y) {
    for (size_t x = 1; x + 1 < width; ++x) {
      const int16_t* d = disparity + y * width + x;
      const int32_t others = *(d - 1) + *(d + 1) + *(d - width) + *(d + width);
      ++counts[Min(Abs(others - 4 * *d), kMost)];
      ++total;
    }
  }
  int32_t median = 0;
  for (size_t below = counts[0]; 2 * below < total; below += counts[median]) ++median;
  // For normally distributed noise, the median is 0.6745 * sqrt(20), or approximately 3, standard
  // deviations.
  const int32_t noise = median / 3;
  return noise > kLeastNoise ? noise : 0;
}

bool HasStep(const ColourMap& map, const Rect& rect, int32_t margin, int32_t step) {
  const Rect around = Widened(map.plan, rect, margin);
  int16_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int16_t* row = map.disparity + map.At(around.x, y);
    for (int32_t x = 0; x < around.width; ++x) {
      low = std::min(low, row[x]);
      high = std::max(high, row[x]);
    }
    if (high - low > step) return true;
  }
  return false;
}

bool IsBesideStep(const ColourMap& map, const Rect& tile, int32_t x, int32_t y) {
  const int32_t own = map.disparity[map.At(x, y)];
  const auto differs = [&](int32_t column, int32_t row) {
    return Abs(map.disparity[map.At(column, row)] - own) > kSurfaceStep;
  };
  return (x > tile.x && differs(x - 1, y)) || (x + 1 < tile.x + tile.width && differs(x + 1, y)) ||
         (y > tile.y && differs(x, y - 1)) || (y + 1 < tile.y + tile.height && differs(x, y + 1));
}

void MeasureDoubt(const ColourMap& map, const Rect& tile, uint8_t* scratch, uint8_t* doubt) {
  const Rect region = Widened(map.plan, tile, kDoubtMargin);
  FillAlone(map, region, scratch);
  CarryOn(region, 1, scratch);
  CarryOn(region, -1, scratch);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const uint8_t found = scratch[(y - region.y) * region.width + x - region.x];
      const bool beside = found >= 1 && found <= kDisplacement;
      const bool thin = beside && IsThin(map, region, scratch, x, y);
      doubt[map.At(x, y)] = thin ? uint8_t{kThinDoubt} : found;
    }
  }
}

}  // namespace starfocus
