// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/majority.h"

#include <algorithm>

namespace starfocus {
namespace {

// Radius in pixels of the disc that TakeMajority reads around each pixel.
constexpr int32_t kRadius = 5;
// Largest horizontal distance from the centre in each row of the disc, starting with the middle
// row.
constexpr int32_t kWidths[kRadius + 1] = {5, 4, 4, 4, 3, 0};
// The weight of a neighbouring pixel decreases with its squared distance from the pixel and with
// the difference between both colours.
constexpr int32_t kNearWeight = 36, kColourWeight = 64;

// A pixel moves to the median of its surface only if both differ by more than kRough, in fixed
// point (kDisparityBits).
constexpr int32_t kRough = (1 << kDisparityBits) / 4;

// Range of the disparities around a pixel, or of the disparities in a column.
struct MajorityRange {
  int32_t low = INT16_MAX, high = INT16_MIN;

  void Add(const MajorityRange& range) {
    low = Min(low, range.low);
    high = Max(high, range.high);
  }
  bool IsOneSurface() const { return high - low <= kMajorityStep; }
};

// Range of the disparities in each column around a row of pixels. Each column extends
// kMajorityReach rows up and down from the row.
struct ColumnRanges {
  Rect around;
  MajorityRange ranges[kMostMajority + 2 * kMajorityReach], all;

  ColumnRanges(const ColourMap& map, const Rect& row)
      : around(Widened(map.plan, row, kMajorityReach)) {
    for (int32_t y = around.y; y < around.y + around.height; ++y) {
      const int16_t* disparities = map.disparity + map.At(around.x, y);
      for (int32_t k = 0; k < around.width; ++k) ranges[k].Add({disparities[k], disparities[k]});
    }
    for (int32_t k = 0; k < around.width; ++k) all.Add(ranges[k]);
  }
  MajorityRange Around(int32_t x) const {
    const int32_t first = Max(x - kMajorityReach - around.x, 0);
    const int32_t last = Min(x + kMajorityReach - around.x, around.width - 1);
    MajorityRange range;
    for (int32_t k = first; k <= last; ++k) range.Add(ranges[k]);
    return range;
  }
};

// The disparities of a pixel and of those of its eight neighbours that are on the pixel's surface.
struct SurfaceAround {
  int16_t sorted[9];
  int32_t count = 0;

  SurfaceAround(const ColourMap& map, int32_t x, int32_t y) {
    const int32_t own = map.disparity[map.At(x, y)];
    const Rect around = Widened(map.plan, {x, y, 1, 1}, 1);
    for (int32_t row = around.y; row < around.y + around.height; ++row) {
      const int16_t* disparities = map.disparity + map.At(around.x, row);
      for (int32_t k = 0; k < around.width; ++k) {
        if (Abs(disparities[k] - own) <= kMajorityStep) Insert(disparities[k]);
      }
    }
  }
  void Insert(int16_t disparity) {
    int32_t at = count++;
    for (; at > 0 && sorted[at - 1] > disparity; --at) sorted[at] = sorted[at - 1];
    sorted[at] = disparity;
  }
};

int16_t MajorityAt(const ColourMap& map, int32_t x, int32_t y, const MajorityRange& range) {
  const int32_t own = map.disparity[map.At(x, y)], middle = (range.low + range.high) / 2;
  const uint8_t* colour = map.Pixel(x, y);
  int64_t sums[2] = {};
  int32_t votes[2] = {};
  for (int32_t dy = -Min(y, kRadius); dy <= Min(map.plan.height - 1 - y, kRadius); ++dy) {
    const int32_t width = kWidths[Abs(dy)], last = Min(map.plan.width - 1 - x, width);
    const uint8_t* colours = map.Pixel(x, y + dy);
    const int16_t* disparities = map.disparity + map.At(x, y + dy);
    for (int32_t dx = -Min(x, width); dx <= last; ++dx) {
      const int32_t difference = ColourDifference(colour, colours + 3 * dx);
      const int32_t weight = (kNearWeight - dx * dx - dy * dy) * Max(1, kColourWeight - difference);
      const int side = disparities[dx] > middle ? 1 : 0;
      votes[side] += weight;
      sums[side] += int64_t{weight} * disparities[dx];
    }
  }
  const int own_side = own > middle ? 1 : 0, other = 1 - own_side;
  if (votes[other] > votes[own_side]) return static_cast<int16_t>(sums[other] / votes[other]);
  constexpr int32_t kOwnVote = kNearWeight * kColourWeight;
  // A pixel that is alone with its disparity joins the other pixels of its side.
  if (votes[own_side] == kOwnVote || SurfaceAround(map, x, y).count > 1) {
    return static_cast<int16_t>(own);
  }
  return static_cast<int16_t>((sums[own_side] - int64_t{kOwnVote} * own) /
                              (votes[own_side] - kOwnVote));
}

}  // namespace

void TakeMajority(const ColourMap& map, const Rect& row, int16_t* disparity) {
  std::copy_n(map.disparity + map.At(row.x, row.y), row.width, disparity);
  const ColumnRanges columns(map, row);
  if (columns.all.IsOneSurface()) return;
  for (int32_t k = 0; k < row.width; ++k) {
    const MajorityRange range = columns.Around(row.x + k);
    if (!range.IsOneSurface()) disparity[k] = MajorityAt(map, row.x + k, row.y, range);
  }
}

int16_t MedianOfSurface(const ColourMap& map, int32_t x, int32_t y) {
  const int16_t own = map.disparity[map.At(x, y)];
  const SurfaceAround around(map, x, y);
  const int16_t median = around.sorted[around.count / 2];
  return Abs(median - own) > kRough ? median : own;
}

}  // namespace starfocus
