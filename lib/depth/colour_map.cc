// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_map.h"

#include <algorithm>
#include <cmath>

namespace starfocus {
namespace {

constexpr int16_t kUnknown = INT16_MIN;
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

void SmoothTile(const ColourMap& map, int32_t radius, int32_t step, int32_t tolerance,
                const Rect& tile, const simd::DepthKernels& kernels, int32_t* ring,
                int16_t* smooth) {
  const int32_t bottom = tile.y + tile.height;
  const auto row_at = [ring](int32_t y) { return ring + y % kSmoothRows * 4 * kSmoothPlane; };
  int32_t filled = Max(tile.y - radius, 0);
  for (int32_t y = tile.y; y < bottom; ++y) {
    for (; filled <= y + radius && filled < map.setup.height; ++filled) {
      FillPlanes(map, tile.x - radius, tile.width + 2 * radius, filled, row_at(filled));
    }
    const int32_t* rows[simd::kMostSmoothRows];
    size_t count = 0;
    for (int32_t row = y - radius; row <= y + radius; row += step) {
      if (row >= 0 && row < map.setup.height) rows[count++] = row_at(row) + radius;
    }
    kernels.SmoothDisparity(row_at(y) + radius, rows, count, kSmoothPlane, radius, step, tolerance,
                            static_cast<size_t>(tile.width), smooth + map.setup.At(tile.x, y));
  }
}

}  // namespace starfocus
