// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/outlines.h"

#include <algorithm>

#include "lib/optics/view_set.h"

namespace starfocus {
namespace {

// Pixels whose disparities differ by less than kSame belong to one surface.
constexpr int32_t kSame = 2 << kDisparityBits;
// A colour profile across an edge extends from the third pixel of the nearer surface to the seventh
// pixel of the farther surface.
constexpr int32_t kInside = 3, kOutside = 6;
// Smallest squared distance between the colours at both ends of a profile, in grey levels squared.
// Profiles that measure the softness of the picture require at least kLeastContrast. Profiles that
// decide about a single pixel require at least kLeastPixelContrast.
constexpr int32_t kLeastContrast = 60 * 60, kLeastPixelContrast = 30 * 30;
// Reciprocals of the smallest share of the nearer surface in a mixed pixel: kLeastShare for
// measuring edges, and kLeastPixelShare for widening a surface. At half of all sharp ray-traced
// edges, the nearer surface has a share of less than 0.06 in the mixed pixel. At edges of
// photographs, the nearer surface has a share of 0.09 to 0.34.
constexpr int32_t kLeastShare = 14, kLeastPixelShare = 8;

// Returns true if a colour profile can be measured from pixel (x, y), the first pixel of the
// farther surface, in the direction `side`, which leads away from the nearer surface.
bool IsProfile(const ColourMap& map, int32_t x, int32_t y, const int8_t* side) {
  const auto at = [&](int32_t k) {
    return map.disparity[map.setup.At(x + k * side[0], y + k * side[1])];
  };
  const int32_t near = at(-1), far = at(0);
  if (near - far <= kSoftStep || Abs(at(-kInside) - near) >= kSame) return false;
  for (int32_t k = 1; k <= kOutside; ++k) {
    if (Abs(at(k) - far) >= kSame) return false;
  }
  return true;
}

// Returns the position of a pixel's colour on the line between the colours at the ends of a
// profile: 0 at the far end (k = kOutside), and the squared length of the line, which is the
// contrast of the profile, at the near end (k = -kInside). The pixel lies k pixels beyond pixel (x,
// y).
int32_t PlaceAt(const ColourMap& map, int32_t x, int32_t y, const int8_t* side, int32_t k) {
  const auto pixel = [&](int32_t at) { return map.Pixel(x + at * side[0], y + at * side[1]); };
  const uint8_t *const near = pixel(-kInside), *const far = pixel(kOutside), *const here = pixel(k);
  int32_t place = 0;
  for (int c = 0; c < 3; ++c) place += (here[c] - far[c]) * (near[c] - far[c]);
  return place;
}

// Returns true if profiles in all four directions at pixel (x, y) lie in the picture.
bool IsInside(const ColourMap& map, int32_t x, int32_t y) {
  return x >= kOutside && x < map.setup.width - kOutside && y >= kOutside &&
         y < map.setup.height - kOutside;
}

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

// The disparities of a pixel and of those of its eight neighbours that are on the pixel's surface.
struct SurfaceAround {
  int16_t sorted[9];
  int32_t count = 0;

  SurfaceAround(const ColourMap& map, int32_t x, int32_t y) {
    const int32_t own = map.disparity[map.setup.At(x, y)];
    const Rect around = Widened(map.setup, {x, y, 1, 1}, 1);
    for (int32_t row = around.y; row < around.y + around.height; ++row) {
      const int16_t* disparities = map.disparity + map.setup.At(around.x, row);
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

// Returns the disparity of pixel (x, y) after the vote of the surrounding pixels. Disparities up to
// `middle` belong to one side, and larger disparities to the other side.
int16_t MajorityAt(const ColourMap& map, int32_t x, int32_t y, int32_t middle) {
  const int32_t own = map.disparity[map.setup.At(x, y)];
  const uint8_t* colour = map.Pixel(x, y);
  int64_t sums[2] = {};
  int32_t votes[2] = {};
  for (int32_t dy = -Min(y, kRadius); dy <= Min(map.setup.height - 1 - y, kRadius); ++dy) {
    const int32_t width = kWidths[Abs(dy)], last = Min(map.setup.width - 1 - x, width);
    const uint8_t* colours = map.Pixel(x, y + dy);
    const int16_t* disparities = map.disparity + map.setup.At(x, y + dy);
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

CellRanges TakeCellRanges(const ThinGrid& grid, Arena* arena) {
  const auto cells = static_cast<size_t>(grid.Cells());
  CellRanges ranges;
  ranges.low = arena->Take<int16_t>(cells);
  ranges.high = arena->Take<int16_t>(cells);
  return ranges;
}

void MeasureCells(const ThinGrid& grid, const int16_t* map, int32_t index,
                  const CellRanges& ranges) {
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    int16_t low = INT16_MAX, high = INT16_MIN;
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      const int16_t* row = map + static_cast<ptrdiff_t>(y) * grid.width + cell.x;
      for (int32_t x = 0; x < cell.width; ++x) {
        low = std::min(low, row[x]);
        high = std::max(high, row[x]);
      }
    }
    ranges.low[number] = low;
    ranges.high[number] = high;
  });
}

bool MayHaveStep(const ThinGrid& grid, const CellRanges& ranges, int32_t number, int32_t step) {
  int16_t low = INT16_MAX, high = INT16_MIN;
  ForAround(grid, number % grid.columns, number / grid.columns, 1,
            [&](int32_t, int32_t, int32_t other) {
              low = std::min(low, ranges.low[other]);
              high = std::max(high, ranges.high[other]);
            });
  return high - low > step;
}

void CountSoft(const ColourMap& map, const Rect& rect, SoftCount* count) {
  for (int32_t y = rect.y; y < rect.y + rect.height; ++y) {
    for (int32_t x = rect.x; x < rect.x + rect.width; ++x) {
      if (!IsInside(map, x, y)) continue;
      for (const auto& side : kSides) {
        if (!IsProfile(map, x, y, side)) continue;
        const int32_t contrast = PlaceAt(map, x, y, side, -kInside);
        if (contrast < kLeastContrast) continue;
        ++count->edges;
        for (int32_t k = 1; k <= kMostSoft; ++k) {
          count->mixed[k - 1] += kLeastShare * PlaceAt(map, x, y, side, k) >= contrast ? 1 : 0;
        }
      }
    }
  }
}

int32_t SoftnessOf(const SoftCount* counts, int32_t tiles) {
  int64_t edges = 0, mixed[kMostSoft] = {};
  for (int32_t tile = 0; tile < tiles; ++tile) {
    edges += counts[tile].edges;
    for (int32_t k = 0; k < kMostSoft; ++k) mixed[k] += counts[tile].mixed[k];
  }
  int32_t soft = 0;
  while (soft < kMostSoft && edges > 0 && 2 * mixed[soft] >= edges) ++soft;
  return soft == 0 ? 0 : Min(soft + 1, kMostSoft);
}

int16_t WidenedAt(const ColourMap& map, int32_t softness, int32_t x, int32_t y) {
  const int16_t own = map.disparity[map.setup.At(x, y)];
  int16_t nearest = own;
  for (const auto& side : kSides) {
    for (int32_t k = 0; k < softness; ++k) {
      const int32_t column = x - k * side[0], row = y - k * side[1];
      if (!IsInside(map, column, row)) break;
      const int16_t near = map.disparity[map.setup.At(column - side[0], row - side[1])];
      if (near - own <= kSoftStep) continue;
      if (near <= nearest) break;
      const int32_t contrast = PlaceAt(map, column, row, side, -kInside);
      const int32_t place = PlaceAt(map, column, row, side, k);
      if (contrast >= kLeastPixelContrast && kLeastPixelShare * place >= contrast) nearest = near;
      break;
    }
  }
  return nearest;
}

void TakeMajority(const ColourMap& map, const Rect& row, int16_t* disparity) {
  std::copy_n(map.disparity + map.setup.At(row.x, row.y), row.width, disparity);
  const Rect around = Widened(map.setup, row, kMajorityReach);
  // Range of the disparities in each column of `around`.
  int16_t low[kMostMajority + 2 * kMajorityReach], high[kMostMajority + 2 * kMajorityReach];
  std::fill_n(low, around.width, INT16_MAX);
  std::fill_n(high, around.width, INT16_MIN);
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int16_t* disparities = map.disparity + map.setup.At(around.x, y);
    for (int32_t k = 0; k < around.width; ++k) {
      low[k] = std::min(low[k], disparities[k]);
      high[k] = std::max(high[k], disparities[k]);
    }
  }
  const int32_t nearest = *std::max_element(high, high + around.width);
  if (nearest - *std::min_element(low, low + around.width) <= kMajorityStep) return;
  for (int32_t k = 0; k < row.width; ++k) {
    const int32_t first = Max(row.x + k - kMajorityReach - around.x, 0);
    const int32_t end = Min(row.x + k + kMajorityReach + 1 - around.x, around.width);
    const int32_t least = *std::min_element(low + first, low + end);
    const int32_t most = *std::max_element(high + first, high + end);
    if (most - least <= kMajorityStep) continue;
    disparity[k] = MajorityAt(map, row.x + k, row.y, (least + most) / 2);
  }
}

int16_t MedianOfSurface(const ColourMap& map, int32_t x, int32_t y) {
  const int16_t own = map.disparity[map.setup.At(x, y)];
  const SurfaceAround around(map, x, y);
  const int16_t median = around.sorted[around.count / 2];
  return Abs(median - own) > kRough ? median : own;
}

}  // namespace starfocus
