// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/repair_map.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "lib/depth/estimate_clean.h"
#include "lib/depth/swept.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest difference of disparity between neighbours on one surface. Slopes steeper than kMostSlope
// are blurred edges.
constexpr int32_t kMostSlope = kPixel / 2;
// Largest difference between disparities that are averaged as one surface, in fixed point
// (kDisparityBits).
constexpr int32_t kSameSurface = 38;
// Largest difference at which a disparity counts as equal to the given disparity.
constexpr int32_t kSame = kPixel / 4;
constexpr int32_t kMeanRadius = 3, kEvidenceRadius = 2;
// Largest distance in pixels from a pixel that mixes two surfaces to trusted disparities of the
// nearer surface. kNearReach spans a ramp of disparities that is 12 pixels long, and the untrusted
// pixels at the ends of the ramp.
constexpr int32_t kNearReach = 16;
// Largest cost of a pixel that the views show clearly. kClearCost corresponds to 11 grey levels. In
// images of hair in front of a wall, half of the wall pixels and a twentieth of the mixed pixels
// have a cost below kClearCost.
constexpr int32_t kClearCost = 44;

size_t IndexOf(const EstimatePlan& plan, int32_t x, int32_t y) {
  return static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x);
}

// Smallest and largest disparity in each column of three pixels: the pixel of a row and the pixels
// above and below it.
struct ColumnExtremes {
  int16_t low[kMostTileSide + 2], high[kMostTileSide + 2];

  void Copy(int32_t from, int32_t to) {
    low[to] = low[from];
    high[to] = high[from];
  }
};

// Fills elements [begin, end) of `columns`. `at` points to a row of disparities. The previous row
// is `above` samples before this row, and the next row is `below` samples after this row.
void FindColumns(const int16_t* at, ptrdiff_t above, ptrdiff_t below, int32_t begin, int32_t end,
                 ColumnExtremes* columns) {
  for (int32_t k = begin; k < end; ++k) {
    const int16_t up = at[k - above], here = at[k], down = at[k + below];
    columns->low[k] = std::min(std::min(up, down), here);
    columns->high[k] = std::max(std::max(up, down), here);
  }
}

struct Mean {
  int32_t sum = 0, count = 0;

  void Add(int32_t value) {
    sum += value;
    ++count;
  }
  // Returns the mean of the added values, with halves rounded away from zero.
  int32_t Value() const { return (2 * sum + (sum < 0 ? -count : count)) / (2 * count); }
};

// Returns the mean disparity, around pixel (x, y), of the surface at disparity `own`. If trusted
// disparities of this surface exist, only trusted disparities are averaged.
int32_t MeanOfSurface(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y,
                      int32_t own) {
  const Rect around = Widened(plan, {x, y, 1, 1}, kMeanRadius);
  Mean trusted, found;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const size_t at = IndexOf(plan, column, row);
      if (std::abs(memory.second[at] - own) > kSameSurface) continue;
      found.Add(memory.second[at]);
      const int32_t d = memory.trusted[at];
      if (d != simd::kNoSurface && std::abs(d - own) <= kSameSurface) trusted.Add(d);
    }
  }
  return trusted.count > 0 ? trusted.Value() : found.Value();
}

// Returns true if less than a quarter of the pixels around pixel (x, y) are trusted. A rough part
// of the map is noise, or a wide slope in place of an edge, and is not worth keeping.
bool IsRough(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y) {
  const Rect around = Widened(plan, {x, y, 1, 1}, kMeanRadius);
  int32_t smooth = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      smooth += memory.trusted[IndexOf(plan, column, row)] != simd::kNoSurface;
    }
  }
  return 4 * smooth < around.width * around.height;
}

}  // namespace

void ReadGiven(const EstimatePlan& plan, const starfocus_light_field& light_field, const Rect& tile,
               EstimateMemory* memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const float* row = GivenAt(light_field, y);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = IndexOf(plan, x, y);
      memory->given[at] = std::isfinite(row[x]) ? static_cast<int16_t>(std::lrint(row[x] * kPixel))
                                                : simd::kNoSurface;
      memory->first[at] = memory->second[at] = memory->given[at];
      memory->given_cost[at] = memory->found_cost[at] = 0;
    }
  }
}

void FindTrusted(const EstimatePlan& plan, const Rect& tile, const int16_t* given,
                 int16_t* trusted) {
  ColumnExtremes columns;
  // Element 0 of `columns` is the column to the left of the tile. The range [begin, end) omits
  // columns outside the picture.
  const int32_t begin = tile.x > 0 ? 0 : 1,
                end = tile.width + (tile.x + tile.width < plan.width ? 2 : 1);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const ptrdiff_t above = y > 0 ? plan.width : 0, below = y + 1 < plan.height ? plan.width : 0;
    FindColumns(given + IndexOf(plan, tile.x, y) - 1, above, below, begin, end, &columns);
    if (begin > 0) columns.Copy(1, 0);
    if (end < tile.width + 2) columns.Copy(tile.width, tile.width + 1);
    const int16_t* from = given + IndexOf(plan, tile.x, y);
    int16_t* to = trusted + IndexOf(plan, tile.x, y);
    const int16_t *low = columns.low, *high = columns.high;
    for (int32_t k = 0; k < tile.width; ++k) {
      const int16_t least = std::min(std::min(low[k], low[k + 2]), low[k + 1]);
      const int16_t most = std::max(std::max(high[k], high[k + 2]), high[k + 1]);
      const bool smooth = (least != simd::kNoSurface) & (most <= least + kMostSlope);
      to[k] = smooth ? from[k] : simd::kNoSurface;
    }
  }
}

void EvenOut(const EstimatePlan& plan, const Plane<const uint8_t>& centre, const Rect& tile,
             const EstimateMemory& memory, int16_t* evened) {
  ForSwept(plan, memory.swept, tile, [&](int32_t x, int32_t y) {
    const size_t at = IndexOf(plan, x, y);
    const int32_t given = memory.given[at], trusted = memory.trusted[at];
    evened[at] = static_cast<int16_t>(given);
    if (trusted != simd::kNoSurface && std::abs(trusted - memory.second[at]) <= kSame) return;
    const int32_t own = WithoutStray(plan, centre, memory.second, x, y);
    const int32_t mean = MeanOfSurface(plan, memory, x, y, own);
    if (given != simd::kNoSurface && std::abs(given - mean) <= kSame) return;
    evened[at] = static_cast<int16_t>(mean);
  });
}

bool Differs(const EstimateMemory& memory, size_t at) {
  return memory.given[at] == simd::kNoSurface ||
         std::abs(memory.first[at] - memory.given[at]) > kPixel / 2;
}

TileCount CountTile(const EstimatePlan& plan, const Rect& tile, const EstimateMemory& memory) {
  TileCount count = {};
  ForSwept(plan, memory.swept, tile, [&](int32_t x, int32_t y) {
    const size_t at = IndexOf(plan, x, y);
    count.rough += memory.trusted[at] == simd::kNoSurface;
    count.differs += Differs(memory, at);
  });
  return count;
}

int16_t RepairedAt(const EstimatePlan& plan, const EstimateMemory& memory, int32_t x, int32_t y) {
  const size_t own = IndexOf(plan, x, y);
  const int16_t given = memory.given[own], found = memory.first[own];
  if (given == simd::kNoSurface) return found;
  if (!Differs(memory, own)) {
    return memory.least_evidence < kSweepEvidence.right ? found : given;
  }
  if (IsRough(plan, memory, x, y)) return found;
  const Rect around = Widened(plan, {x, y, 1, 1}, kEvidenceRadius);
  int32_t evidence = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const size_t at = IndexOf(plan, column, row);
      if (Differs(memory, at)) evidence += memory.given_cost[at] - memory.found_cost[at];
    }
  }
  return evidence >= memory.least_evidence ? found : given;
}

void FindNearest(const EstimatePlan& plan, const int16_t* trusted, const Rect& cell, int32_t y,
                 int16_t* nearest) {
  const Rect around = Widened(plan, {cell.x, y, cell.width, 1}, kNearReach);
  // Largest disparity in each column; columns[0] is kNearReach columns to the left of the cell.
  int16_t columns[kMostCellSide + 2 * kNearReach];
  std::fill_n(columns, cell.width + 2 * kNearReach, simd::kNoSurface);
  int16_t* to = columns + kNearReach - (cell.x - around.x);
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* from = trusted + IndexOf(plan, around.x, row);
    for (int32_t x = 0; x < around.width; ++x) to[x] = std::max(to[x], from[x]);
  }
  std::fill_n(nearest, cell.width, simd::kNoSurface);
  for (int32_t k = 0; k <= 2 * kNearReach; ++k) {
    for (int32_t x = 0; x < cell.width; ++x) nearest[x] = std::max(nearest[x], columns[x + k]);
  }
}

int16_t PartedAt(const EstimateMemory& memory, size_t at, int16_t nearest) {
  const int16_t given = memory.given[at], found = memory.first[at];
  const bool sloping = memory.trusted[at] == simd::kNoSurface && nearest != simd::kNoSurface;
  const int16_t near = sloping ? nearest : given;
  if (near == simd::kNoSurface) return found;
  const bool clear = memory.found_cost[at] <= kClearCost &&
                     std::abs(found - memory.second[at]) < kPixel && found < near - kPixel;
  return clear ? found : near;
}

}  // namespace starfocus
