// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/swept.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/io/image.h"
#include "simd/disparities.h"
#include "simd/match.h"

namespace starfocus {
namespace {

constexpr int32_t kPixel = 1 << kDisparityBits;
// Largest difference of disparity between neighbours on one surface. Slopes steeper than kMostSlope
// are blurred edges.
constexpr int32_t kMostSlope = kPixel / 2;

// Fills elements [begin, end) of `low` and `high` with the smallest and the largest disparity of
// each column of three pixels: the pixel of the row `at` and the pixels above and below it. The
// previous row is `above` samples before this row, and the next row is `below` samples after it.
void FindColumns(const int16_t* at, ptrdiff_t above, ptrdiff_t below, int32_t begin, int32_t end,
                 int16_t* low, int16_t* high) {
  for (int32_t k = begin; k < end; ++k) {
    const int16_t up = at[k - above], here = at[k], down = at[k + below];
    low[k] = std::min(std::min(up, down), here);
    high[k] = std::max(std::max(up, down), here);
  }
}

// A pixel fits the views on one side if the mean difference from these views, summed over R, G and
// B, is at most kMostMisfit.
constexpr int32_t kMostMisfit = 20;
// Every second pixel of every second row is tested. A pixel is contradicted if at least
// kLeastMisfits of the 5x5 pixels around the pixel fit badly.
constexpr int32_t kLeastMisfits = 2, kMisfitRadius = 2;
constexpr uint8_t kMisfit = 1, kDoubt = 2;
// Returns true if position `at` is tested, in a row or column of `length` pixels. In a mirrored
// picture, the mirrored pixels are tested.
bool IsTested(int32_t at, int32_t length) { return (std::abs(2 * at - (length - 1)) & 2) == 0; }

// Returns the difference between a pixel and the view at (x, y); coordinates are in 1/128 pixel.
// Returns simd::kMostDifference if the view does not cover (x, y).
int32_t Misfit(const SweepSetup& setup, const Plane<const uint8_t>& view, int32_t x, int32_t y,
               const uint8_t* pixel) {
  const int32_t column = x >> kMoveBits, row = y >> kMoveBits;
  const int32_t across = x & (kMoveOne - 1), down = y & (kMoveOne - 1);
  const int32_t right = across > 0 ? 3 : 0, below = down > 0 ? 1 : 0;
  if (column < 0 || 3 * column + right >= 3 * setup.width || row < 0 ||
      row + below >= setup.height) {
    return simd::kMostDifference;
  }
  const uint8_t* at = view.data + static_cast<size_t>(row) * view.stride + 3 * column;
  const uint8_t* next = at + static_cast<size_t>(below) * view.stride;
  int32_t misfit = 0;
  for (int32_t c = 0; c < 3; ++c) {
    const auto between = [&](const uint8_t* from) {
      return from[c] * kMoveOne + (from[c + right] - from[c]) * across;
    };
    int32_t value = between(at) * kMoveOne;
    if (down != 0) value += (between(next) - between(at)) * down;
    misfit += std::abs(((value + (1 << (2 * kMoveBits - 1))) >> (2 * kMoveBits)) - pixel[c]);
  }
  return Min(misfit, simd::kMostDifference);
}

// Returns true if the views on any side fit pixel (x, y) at disparity d.
bool Fits(const SweepSetup& setup, const starfocus_light_field& light_field, int32_t x, int32_t y,
          int32_t d) {
  const Plane<const uint8_t> centre = RowsOf(light_field.views[0]);
  const uint8_t* pixel = centre.data + static_cast<size_t>(y) * centre.stride + 3 * x;
  const int32_t along = setup.arms == 4 ? 2 : 3;  // as in simd::LabelRow
  int32_t misfit[8];
  for (int32_t arm = 0; arm < setup.arms + along - 1; ++arm) {
    if (arm < setup.arms) {
      const SideView& side = setup.side[arm];
      misfit[arm] =
          Misfit(setup, RowsOf(light_field.views[side.index]), kMoveOne * x + MoveAcross(side, d),
                 kMoveOne * y + MoveDown(side, d), pixel);
    }
    if (arm < along - 1) continue;
    int32_t sum = 0;
    for (int32_t k = 0; k < along; ++k) sum += misfit[(arm - k) % setup.arms];
    if (sum <= along * kMostMisfit) return true;
  }
  return false;
}

// Returns the difference between the colours of two pixels, clamped to simd::kMostDifference.
int32_t Apart(const uint8_t* a, const uint8_t* b) {
  const int32_t sum = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
  return Min(sum, simd::kMostDifference);
}

// Returns true if at least kLeastMisfits of the pixels around pixel (x, y) fit the views badly.
bool IsGainsaid(const SweepSetup& setup, const uint8_t* doubt, int32_t x, int32_t y) {
  const Rect around = Widened(setup, {x, y, 1, 1}, kMisfitRadius);
  int32_t misfits = 0;
  ForPixels(around, [&](int32_t column, int32_t row) {
    misfits += doubt[setup.At(column, row)] == kMisfit;
  });
  return misfits >= kLeastMisfits;
}

// Marks of doubt for a row of a tile and kSweptRadius pixels on each side. Pixels outside the
// picture are not in doubt.
using DoubtRow = uint8_t[kMostTileSide + 2 * kSweptRadius];

// Sets row[k] to 1 if pixel k of row y is in doubt. row[0] is the first pixel of `around`.
void ReadDoubts(const SweepSetup& setup, const uint8_t* doubt, const Rect& around, int32_t y,
                uint8_t* row) {
  const uint8_t* from = doubt + setup.At(0, y);
  for (int32_t x = around.x; x < around.x + around.width; ++x) {
    const uint8_t own = from[x];
    row[x - around.x] = own == kDoubt || (own == kMisfit && IsGainsaid(setup, doubt, x, y));
  }
}

}  // namespace

void ReadGiven(const SweepSetup& setup, const starfocus_light_field& light_field, const Rect& tile,
               const EstimateMemory& memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const float* row = GivenAt(light_field, y);
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = setup.At(x, y);
      memory.given[at] = std::isfinite(row[x]) ? static_cast<int16_t>(std::lrint(row[x] * kPixel))
                                               : simd::kNoSurface;
      memory.first[at] = memory.second[at] = memory.given[at];
      memory.given_cost[at] = memory.found_cost[at] = 0;
    }
  }
}

void FindTrusted(const SweepSetup& setup, const Rect& tile, const int16_t* given,
                 int16_t* trusted) {
  int16_t low[kMostTileSide + 2], high[kMostTileSide + 2];
  // Element 0 of `low` and `high` is the column to the left of the tile. The range [begin, end)
  // omits columns outside the picture, which get the values of the columns beside them.
  const int32_t width = tile.width, begin = tile.x > 0 ? 0 : 1;
  const int32_t end = width + (tile.x + width < setup.width ? 2 : 1);
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const ptrdiff_t above = y > 0 ? setup.width : 0, below = y + 1 < setup.height ? setup.width : 0;
    FindColumns(given + setup.At(tile.x, y) - 1, above, below, begin, end, low, high);
    if (begin > 0) low[0] = low[1], high[0] = high[1];
    if (end < width + 2) low[width + 1] = low[width], high[width + 1] = high[width];
    const int16_t* from = given + setup.At(tile.x, y);
    int16_t* to = trusted + setup.At(tile.x, y);
    for (int32_t k = 0; k < width; ++k) {
      const int16_t least = std::min(std::min(low[k], low[k + 2]), low[k + 1]);
      const int16_t most = std::max(std::max(high[k], high[k + 2]), high[k + 1]);
      const bool smooth = (least != simd::kNoSurface) & (most <= least + kMostSlope);
      to[k] = smooth ? from[k] : simd::kNoSurface;
    }
  }
}

void FindDoubts(const SweepSetup& setup, const starfocus_light_field& light_field, const Rect& tile,
                const EstimateMemory& memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t row = setup.At(0, y);
    const int16_t* trusted = memory.trusted + row;
    uint8_t* doubt = memory.doubt + row;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      doubt[x] = trusted[x] == simd::kNoSurface ? kDoubt : uint8_t{0};
    }
    if (!IsTested(y, setup.height)) continue;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      if (doubt[x] != 0 || !IsTested(x, setup.width)) continue;
      if (!Fits(setup, light_field, x, y, trusted[x])) doubt[x] = kMisfit;
    }
  }
}

void FindSwept(const SweepSetup& setup, const Rect& tile, uint8_t* scratch,
               const EstimateMemory& memory) {
  const Rect around = Widened(setup, tile, kSweptRadius);
  const auto stride = static_cast<size_t>(tile.width);
  DoubtRow row = {};
  uint8_t* inside = row + kSweptRadius - (tile.x - around.x);
  // First mark the pixels that have a pixel in doubt within kSweptRadius pixels in their row.
  for (int32_t y = 0; y < around.height; ++y) {
    ReadDoubts(setup, memory.doubt, around, around.y + y, inside);
    uint8_t* near = scratch + static_cast<size_t>(y) * stride;
    std::fill_n(near, stride, uint8_t{0});
    for (size_t k = 0; k <= 2 * kSweptRadius; ++k) {
      for (size_t x = 0; x < stride; ++x) near[x] |= row[k + x];
    }
  }
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    uint8_t* swept = memory.swept + setup.At(tile.x, y);
    std::fill_n(swept, tile.width, uint8_t{0});
    const int32_t first = Max(around.y, y - kSweptRadius);
    const int32_t last = Min(around.y + around.height - 1, y + kSweptRadius);
    for (int32_t from = first; from <= last; ++from) {
      const uint8_t* near = scratch + static_cast<size_t>(from - around.y) * stride;
      for (size_t x = 0; x < stride; ++x) swept[x] |= near[x];
    }
  }
}

void RateUnswept(const SweepSetup& setup, const Plane<const uint8_t>& centre, const Rect& tile,
                 const EstimateMemory& memory) {
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const size_t row = setup.At(0, y);
    const uint8_t* line = centre.data + static_cast<size_t>(y) * centre.stride;
    const auto stride = static_cast<ptrdiff_t>(centre.stride);
    // At an edge of the picture, the opposite neighbour replaces the missing neighbour.
    const ptrdiff_t down = y + 1 < setup.height ? stride : y > 0 ? -stride : 0;
    const ptrdiff_t up = y > 0 ? -stride : down;
    for (int32_t x = tile.x; x < tile.x + tile.width; ++x) {
      const size_t at = row + static_cast<size_t>(x);
      if (memory.swept[at] != 0) continue;
      const uint8_t* pixel = line + 3 * x;
      const ptrdiff_t right = x + 1 < setup.width ? 3 : x > 0 ? -3 : 0, left = x > 0 ? -3 : right;
      const int32_t across = Min(Apart(pixel, pixel + left), Apart(pixel, pixel + right));
      const int32_t along = Min(Apart(pixel, pixel + up), Apart(pixel, pixel + down));
      memory.certainty[at] = static_cast<uint8_t>(simd::kCostScale * (across + along) / 2);
    }
  }
}

}  // namespace starfocus
