// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/colour_smooth.h"

namespace starfocus {
namespace {

// Disparity of pixels outside the picture, which differs from all other disparities by more than
// any tolerance.
constexpr int32_t kOutside = INT32_MIN / 2;
constexpr uint8_t kBlack[3] = {};
constexpr int32_t kPlane = SmoothMemory::kPlane;

// Fills columns [first, first + count) of the planes of row y. Columns may lie outside the picture.
void FillPlanes(const ColourMap& map, int32_t first, int32_t count, int32_t y, int32_t* row) {
  for (int32_t k = 0; k < count; ++k) {
    const int32_t x = first + k;
    const bool inside = x >= 0 && x < map.plan.width;
    const uint8_t* colour = inside ? map.Pixel(x, y) : kBlack;
    row[k] = inside ? map.disparity[map.At(x, y)] : kOutside;
    row[k + kPlane] = colour[0] + colour[1] + colour[2];
    row[k + 2 * kPlane] = colour[0] - colour[1];
    row[k + 3 * kPlane] = colour[1] - colour[2];
  }
}

}  // namespace

void SmoothTile(const ColourMap& map, const Smoothing& smoothing, const Rect& tile,
                const simd::DepthKernels& kernels, SmoothMemory* memory, int16_t* smooth) {
  const int32_t radius = smoothing.radius, bottom = tile.y + tile.height;
  const auto row_at = [memory](int32_t y) { return memory->rows[y % SmoothMemory::kRows]; };
  simd::SmoothRows rows = {};
  rows.plane = kPlane;
  rows.radius = radius;
  rows.step = smoothing.step;
  rows.tolerance = smoothing.tolerance;
  int32_t filled = Max(tile.y - radius, 0);
  for (int32_t y = tile.y; y < bottom; ++y) {
    for (; filled <= y + radius && filled < map.plan.height; ++filled) {
      FillPlanes(map, tile.x - radius, tile.width + 2 * radius, filled, row_at(filled));
    }
    rows.own = row_at(y) + radius;
    rows.count = 0;
    for (int32_t row = y - radius; row <= y + radius; row += smoothing.step) {
      if (row >= 0 && row < map.plan.height) rows.rows[rows.count++] = row_at(row) + radius;
    }
    kernels.SmoothDisparity(rows, static_cast<size_t>(tile.width), smooth + map.At(tile.x, y));
  }
}

}  // namespace starfocus
