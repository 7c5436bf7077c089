// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_map.h"

#include <algorithm>
#include <cmath>

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

// Fills the unknown pixels of a row, unless no pixel of the row is known.
void FillRow(int32_t width, int16_t* row) {
  int32_t last = -1;
  for (int32_t x = 0; x <= width; ++x) {
    if (x < width && row[x] == kUnknown) continue;
    if (x == width && last < 0) return;
    for (int32_t k = last + 1; k < x; ++k) {
      const int32_t before = k - last, after = x - k;
      const bool left =
          last >= 0 && (x == width || before < after || (before == after && row[last] < row[x]));
      row[k] = left ? row[last] : row[x];
    }
    last = x;
  }
}

// Fills the unknown rows [first, end), which lie between two known rows, or between a known row and
// the top or bottom of the map.
void FillRows(const SweepSetup& setup, int32_t first, int32_t end, int16_t* map) {
  const auto width = static_cast<size_t>(setup.width);
  // If the unknown rows touch the top or bottom of the map, the pointer on that side is invalid and
  // is not read.
  const int16_t* above = map + static_cast<size_t>(Max(first - 1, 0)) * width;
  const int16_t* below = map + static_cast<size_t>(Min(end, setup.height - 1)) * width;
  for (int32_t y = first; y < end; ++y) {
    const int32_t before = first == 0 ? INT32_MAX : y - first + 1;
    const int32_t after = end == setup.height ? INT32_MAX : end - y;
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
  const int32_t own = map.disparity[map.setup.At(x, y)];
  const Rect around = Widened(map.setup, {x, y, 1, 1}, kFlatRadius);
  int32_t flat = 0;
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const int16_t* disparities = map.disparity + map.setup.At(around.x, row);
    for (int32_t k = 0; k < around.width; ++k) flat += Abs(disparities[k] - own) <= kFlat ? 1 : 0;
    if (25 * flat < kLeastFlat * around.width * around.height) continue;
    return IsBesideStep(map, {0, 0, map.setup.width, map.setup.height}, x, y) ? 1 : kDoubtReach + 1;
  }
  return 0;
}

// Extremes of each column of a strip of cells and its surroundings, and the unknown pixels of the
// strip. Element 0 is column `left` of the picture.
struct FlatStrip {
  static constexpr int32_t kMost = kMostTileSide + 2 * (kDoubtMargin + kFlatRadius);

  int32_t left, width;
  int16_t low[kMost], high[kMost];
  uint8_t unknown[kMost];

  FlatStrip(const ColourMap& map, const Rect& strip) {
    const Rect around = Widened(map.setup, strip, kFlatRadius);
    left = around.x;
    width = around.width;
    std::fill_n(low, width, INT16_MAX);
    std::fill_n(high, width, INT16_MIN);
    std::fill_n(unknown, width, uint8_t{0});
    for (int32_t y = around.y; y < around.y + around.height; ++y) {
      const int16_t* row = map.disparity + map.setup.At(left, y);
      for (int32_t k = 0; k < width; ++k) {
        low[k] = std::min(low[k], row[k]);
        high[k] = std::max(high[k], row[k]);
      }
    }
    for (int32_t y = strip.y; y < strip.y + strip.height; ++y) {
      const float* row = GivenAt(map.light_field, y) + left;
      for (int32_t k = 0; k < width; ++k) unknown[k] |= std::isfinite(row[k]) ? 0 : 1;
    }
  }

  // Returns true if columns [x, x + count) of the strip are known, and if these columns and their
  // surroundings are flat.
  bool IsFlat(int32_t x, int32_t count) const {
    const int32_t first = Max(x - kFlatRadius - left, 0);
    const int32_t end = Min(x + count + kFlatRadius - left, width);
    int16_t least = INT16_MAX, most = INT16_MIN;
    for (int32_t k = first; k < end; ++k) {
      least = std::min(least, low[k]);
      most = std::max(most, high[k]);
    }
    uint8_t any = 0;
    for (int32_t k = x - left; k < x - left + count; ++k) any |= unknown[k];
    return any == 0 && most - least <= kFlat;
  }
};

// Fills the initial doubt (DoubtAt) of each pixel of a region. Returns true if a pixel is doubtful.
bool FillAlone(const ColourMap& map, const Rect& region, uint8_t* doubt) {
  bool doubtful = false;
  std::memset(doubt, kDoubtReach + 1,
              static_cast<size_t>(region.width) * static_cast<size_t>(region.height));
  for (int32_t top = 0; top < region.height; top += kFlatCell) {
    const int32_t height = Min(kFlatCell, region.height - top);
    const FlatStrip strip(map, {region.x, region.y + top, region.width, height});
    for (int32_t left = 0; left < region.width; left += kFlatCell) {
      const int32_t width = Min(kFlatCell, region.width - left);
      if (strip.IsFlat(region.x + left, width)) continue;
      for (int32_t y = top; y < top + height; ++y) {
        for (int32_t x = left; x < left + width; ++x) {
          const uint8_t found = DoubtAt(map, region.x + x, region.y + y);
          doubt[y * region.width + x] = found;
          doubtful = doubtful || found <= kDoubtReach;
        }
      }
    }
  }
  return doubtful;
}

// Writes the smallest value of each pixel and its neighbours in a row.
void TakeLeastBeside(int32_t width, const uint8_t* row, uint8_t* least) {
  least[0] = std::min(row[0], row[width > 1 ? 1 : 0]);
  least[width - 1] = std::min(row[width - 1], row[width > 1 ? width - 2 : 0]);
  for (int32_t x = 1; x + 1 < width; ++x) {
    least[x] = std::min(row[x], std::min(row[x - 1], row[x + 1]));
  }
}

// Limits the doubt of each pixel to the smallest doubt of its eight neighbours plus 1.
void LimitToNeighbours(const Rect& region, uint8_t* doubt) {
  uint8_t least[3][FlatStrip::kMost];  // results of TakeLeastBeside for the rows around a row
  const int32_t width = region.width, last = region.height - 1;
  TakeLeastBeside(width, doubt, least[0]);
  for (int32_t y = 0; y <= last; ++y) {
    uint8_t* row = doubt + y * width;
    if (y < last) TakeLeastBeside(width, row + width, least[(y + 1) % 3]);
    const uint8_t *above = least[Max(y - 1, 0) % 3], *own = least[y % 3];
    const uint8_t* below = least[Min(y + 1, last) % 3];
    for (int32_t x = 0; x < width; ++x) {
      const uint8_t around = std::min(own[x], std::min(above[x], below[x]));
      row[x] = std::min(row[x], static_cast<uint8_t>(around + 1));
    }
  }
}

// Returns true if pixel (x, y), which is next to a step, belongs to a surface without a core within
// kDisplacement. A core consists of pixels farther than kDisplacement from all steps. A surface
// that the map has widened on all sides has a core within kDisplacement of each of its pixels.
bool IsThin(const ColourMap& map, const Rect& region, const uint8_t* doubt, int32_t x, int32_t y) {
  const int32_t own = map.disparity[map.setup.At(x, y)];
  const Rect around = Widened(map.setup, {x, y, 1, 1}, kDisplacement);
  for (int32_t row = around.y; row < around.y + around.height; ++row) {
    const uint8_t* doubts = doubt + (row - region.y) * region.width;
    for (int32_t column = around.x; column < around.x + around.width; ++column) {
      const int32_t difference = Abs(map.disparity[map.setup.At(column, row)] - own);
      if (doubts[column - region.x] > kDisplacement && difference <= kPixel) return false;
    }
  }
  return true;
}

// Disparity of pixels outside the picture, which differs from all other disparities by more than
// any tolerance.
constexpr int32_t kOutside = INT32_MIN / 2;
constexpr uint8_t kBlack[3] = {};

// Fills columns [first, first + count) of the planes of row y. Columns may lie outside the picture.
void FillPlanes(const ColourMap& map, int32_t first, int32_t count, int32_t y, int32_t* row) {
  for (int32_t k = 0; k < count; ++k) {
    const int32_t x = first + k;
    const bool inside = x >= 0 && x < map.setup.width;
    const uint8_t* colour = inside ? map.Pixel(x, y) : kBlack;
    row[k] = inside ? map.disparity[map.setup.At(x, y)] : kOutside;
    row[k + kSmoothPlane] = colour[0] + colour[1] + colour[2];
    row[k + 2 * kSmoothPlane] = colour[0] - colour[1];
    row[k + 3 * kSmoothPlane] = colour[1] - colour[2];
  }
}

}  // namespace

void ReadRows(const SweepSetup& setup, const starfocus_light_field& light_field, const Range& rows,
              int16_t* disparity) {
  for (int32_t y = rows.first; y < rows.last; ++y) {
    int16_t* row = disparity + setup.At(0, y);
    const float* given = GivenAt(light_field, y);
    bool unknown = false;
    for (int32_t x = 0; x < setup.width; ++x) {
      const bool known = std::isfinite(given[x]);
      row[x] = known ? ToFixed(given[x]) : kUnknown;
      unknown |= !known;
    }
    if (unknown) FillRow(setup.width, row);
  }
}

void FillUnknownRows(const SweepSetup& setup, int16_t* disparity) {
  int32_t unknown = 0;  // number of unknown rows directly above row y, which remain to be filled
  for (int32_t y = 0; y < setup.height; ++y) {
    if (disparity[setup.At(0, y)] == kUnknown) {
      ++unknown;
      continue;
    }
    FillRows(setup, y - unknown, y, disparity);
    unknown = 0;
  }
  FillRows(setup, setup.height - unknown, setup.height, disparity);
}

void CountNoise(const SweepSetup& setup, const int16_t* disparity, const Range& rows,
                uint32_t* counts) {
  const ptrdiff_t width = setup.width;
  for (int32_t y = Max(rows.first, 1); y < Min(rows.last, setup.height - 1); ++y) {
    const int16_t* row = disparity + y * width;
    for (ptrdiff_t x = 1; x + 1 < width; ++x) {
      const int16_t* d = row + x;
      const int32_t others = *(d - 1) + *(d + 1) + *(d - width) + *(d + width);
      ++counts[Min(Abs(others - 4 * *d), kNoiseCounts - 1)];
    }
  }
}

int32_t NoiseOf(const uint32_t* counts) {
  size_t total = 0;
  for (int32_t k = 0; k < kNoiseCounts; ++k) total += counts[k];
  int32_t median = 0;
  for (size_t below = counts[0]; 2 * below < total; below += counts[median]) ++median;
  // For normally distributed noise, the median is 0.6745 * sqrt(20), or approximately 3, standard
  // deviations.
  const int32_t deviation = median / 3;
  return deviation > kLeastNoise ? deviation : 0;
}

bool HasStep(const ColourMap& map, const Rect& rect, int32_t margin, int32_t step) {
  const Rect around = Widened(map.setup, rect, margin);
  int16_t low = INT16_MAX, high = INT16_MIN;
  for (int32_t y = around.y; y < around.y + around.height; ++y) {
    const int16_t* row = map.disparity + map.setup.At(around.x, y);
    for (int32_t x = 0; x < around.width; ++x) {
      low = std::min(low, row[x]);
      high = std::max(high, row[x]);
    }
    if (high - low > step) return true;
  }
  return false;
}

bool IsBesideStep(const ColourMap& map, const Rect& tile, int32_t x, int32_t y) {
  const int32_t own = map.disparity[map.setup.At(x, y)];
  const auto differs = [&](int32_t column, int32_t row) {
    return Abs(map.disparity[map.setup.At(column, row)] - own) > kSurfaceStep;
  };
  return (x > tile.x && differs(x - 1, y)) || (x + 1 < tile.x + tile.width && differs(x + 1, y)) ||
         (y > tile.y && differs(x, y - 1)) || (y + 1 < tile.y + tile.height && differs(x, y + 1));
}

void MeasureDoubt(const ColourMap& map, const Rect& tile, uint8_t* scratch, uint8_t* doubt) {
  const Rect region = Widened(map.setup, tile, kDoubtMargin);
  if (FillAlone(map, region, scratch)) {
    for (int32_t k = 0; k < kDoubtReach; ++k) LimitToNeighbours(region, scratch);
  }
  for (int32_t y = tile.y; y < tile.y + tile.height; ++y) {
    const uint8_t* found = scratch + (y - region.y) * region.width + tile.x - region.x;
    uint8_t* row = doubt + map.setup.At(tile.x, y);
    std::copy_n(found, tile.width, row);
    ForDoubtful(found, tile.width, [&](int32_t k) {
      const bool beside = found[k] >= 1 && found[k] <= kDisplacement;
      if (beside && IsThin(map, region, scratch, tile.x + k, y)) row[k] = kThinDoubt;
    });
  }
}

void SmoothTile(const ColourMap& map, int32_t radius, int32_t step, int32_t tolerance,
                const Rect& tile, const simd::DepthKernels& kernels, int32_t* ring,
                int16_t* smooth) {
  const int32_t bottom = tile.y + tile.height;
  const auto row_at = [ring](int32_t y) { return ring + y % kSmoothRows * 4 * kSmoothPlane; };
  simd::SmoothRows rows = {};
  rows.plane = kSmoothPlane;
  rows.radius = radius;
  rows.step = step;
  rows.tolerance = tolerance;
  int32_t filled = Max(tile.y - radius, 0);
  for (int32_t y = tile.y; y < bottom; ++y) {
    for (; filled <= y + radius && filled < map.setup.height; ++filled) {
      FillPlanes(map, tile.x - radius, tile.width + 2 * radius, filled, row_at(filled));
    }
    rows.own = row_at(y) + radius;
    rows.count = 0;
    for (int32_t row = y - radius; row <= y + radius; row += step) {
      if (row >= 0 && row < map.setup.height) rows.rows[rows.count++] = row_at(row) + radius;
    }
    kernels.SmoothDisparity(rows, static_cast<size_t>(tile.width),
                            smooth + map.setup.At(tile.x, y));
  }
}

}  // namespace starfocus
