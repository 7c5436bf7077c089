// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/smooth_cells.h"

#include <cstring>

#include "lib/base/fixed.h"

namespace starfocus {

Rect LayerFrame(const Rect& block, int32_t layer) {
  const int32_t border = UpsampleBorder(layer), rest = (1 << layer) - 1;
  return {(block.x >> layer) - border, (block.y >> layer) - border,
          ((block.width + rest) >> layer) + 2 * border,
          ((block.height + rest) >> layer) + 2 * border};
}

Rect BlockCells::PixelsOf(int32_t x, int32_t y) const {
  const Rect frame = LayerFrame(block, layer);
  const int32_t left = x == block.x ? frame.x : x >> layer;
  const int32_t top = y == block.y ? frame.y : y >> layer;
  const bool last_column = x + kCellSize >= block.x + block.width;
  const bool last_row = y + kCellSize >= block.y + block.height;
  const int32_t right = last_column ? frame.x + frame.width : (x + kCellSize) >> layer;
  const int32_t bottom = last_row ? frame.y + frame.height : (y + kCellSize) >> layer;
  return {left, top, right - left, bottom - top};
}

Rect BlockCells::BoundsOf(bool gathered) const {
  int32_t left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN;
  for (int32_t y = block.y; y < block.y + block.height; y += kCellSize) {
    for (int32_t x = block.x; x < block.x + block.width; x += kCellSize) {
      if (IsGathered(x, y) != gathered) continue;
      const Rect pixels = PixelsOf(x, y);
      left = Min(left, pixels.x);
      top = Min(top, pixels.y);
      right = Max(right, pixels.x + pixels.width);
      bottom = Max(bottom, pixels.y + pixels.height);
    }
  }
  if (left >= right) return {};
  return {left, top, right - left, bottom - top};
}

bool BlockCells::AreGathered(const Rect& part) const {
  const auto column = [&](int32_t x) {
    return Clamp(x * (1 << layer), block.x, block.x + block.width - 1) / kCellSize;
  };
  const auto row = [&](int32_t y) {
    return Clamp(y * (1 << layer), block.y, block.y + block.height - 1) / kCellSize;
  };
  for (int32_t y = row(part.y); y <= row(part.y + part.height - 1); ++y) {
    for (int32_t x = column(part.x); x <= column(part.x + part.width - 1); ++x) {
      if (!IsGathered(x * kCellSize, y * kCellSize)) return false;
    }
  }
  return true;
}

namespace {

// Stores the statistics of a cell in the planes that the SIMD kernels read. A cell outside the
// picture represents the repeated edge. A repeated pixel may lie at any position inside the cell.
void StorePlanes(const Cell& cell, const BlurScale& scale, bool outside, size_t plane,
                 int16_t* out) {
  const auto reach = static_cast<int16_t>(ReachOf(cell.r_max));
  for (size_t side = 0; side < 4; ++side) {
    const auto beyond = static_cast<int16_t>(cell.Reach(side));
    out[(simd::kReachLeft + side) * plane] = outside ? reach : beyond;
    out[(simd::kInsideLeft + side) * plane] = outside ? int16_t{kCellSize} : cell.inside[side];
  }
  out[simd::kReachPlane * plane] = reach;
  out[simd::kNearPlane * plane] =
      static_cast<int16_t>(ReachOf(scale.RadiusAbove(Abs(cell.high - scale.focus.far))));
  out[simd::kRadiusPlane * plane] = static_cast<int16_t>(cell.r_max);
  out[simd::kEdgePlane * plane] = cell.has_edge;
  out[simd::kLowPlane * plane] = cell.low;
  out[simd::kHighPlane * plane] = cell.high;
}

// Classifies a cell. [low, high] is the range of disparities within reach of the cell. `widest` is
// the largest range within any single cell in reach.
CellKind KindOf(const BlurScale& scale, int32_t low, int32_t high, int32_t widest) {
  const int32_t range = high - low;
  const auto is_within = [&](int32_t disparities, int32_t limit) {
    return scale.step * disparities <= int64_t{limit} << kStepBits;
  };
  const auto is_gradual_or_low = [&](bool is_step) {
    if (!is_step) return true;
    const int32_t blur = Max(Abs(low - scale.focus.far), Abs(high - scale.focus.far));
    return is_within(range, Max(scale.Radius(blur) / 2, kSharpSmoothRange));
  };
  if (is_within(range, kSmoothRange) && is_gradual_or_low(2 * widest > range)) {
    return CellKind::kFlat;
  }
  // On a slope, the blur may continue to change from cell to cell, so only the change within a cell
  // is limited.
  const bool is_slope = is_within(widest, kSlopeRange) && is_gradual_or_low(3 * widest > 2 * range);
  return is_slope ? CellKind::kSloped : CellKind::kMixed;
}

}  // namespace

Surroundings LoadSurroundings(const CellGrid& grid, const BlurScale& scale, const Rect& cells,
                              int32_t around, int16_t* samples) {
  static_assert(kCellSize == simd::kCellPixels && int{kLeft} == int{simd::kReachLeft} &&
                    int{kBottom} == int{simd::kReachBottom},
                "cells must have the size and the order of sides of the SIMD kernels");
  const auto stride = static_cast<size_t>(cells.width + 2 * around);
  const size_t plane = stride * static_cast<size_t>(cells.height + 2 * around);
  int16_t* out = samples;
  for (int32_t y = cells.y - around; y < cells.y + cells.height + around; ++y) {
    const int32_t row = Clamp(y, 0, grid.rows - 1);
    for (int32_t x = cells.x - around; x < cells.x + cells.width + around; ++x) {
      const int32_t column = Clamp(x, 0, grid.columns - 1);
      StorePlanes(*grid.At(column, row), scale, column != x || row != y, plane, out++);
    }
  }
  std::memset(samples + simd::kCellPlanes * plane, 0, 2 * simd::kSliceLanes * sizeof(*samples));
  const int16_t* const first = samples + static_cast<size_t>(around) * (stride + 1);
  return {first, plane, stride, cells.x, cells.y, cells.width, cells.height, around};
}

BlockStats MeasureBlock(const simd::Kernels& kernels, const CellGrid& grid,
                        const Surroundings& surroundings, int32_t column, int32_t row) {
  simd::BlockReach reach;
  kernels.ReachBlock(surroundings.At(column, row), surroundings.plane, surroundings.stride,
                     surroundings.around, kUpsampleBorder, &reach);
  BlockStats stats = {INT32_MAX, INT32_MAX, reach.radius, reach.edge > 0, {}, {}};
  for (int32_t y = row; y < Min(row + 2, grid.rows); ++y) {
    for (int32_t x = column; x < Min(column + 2, grid.columns); ++x) {
      const Cell& cell = *grid.At(x, y);
      stats.r_min = Min(stats.r_min, cell.r_min);
      AddCell(cell, &stats.content);
    }
  }
  // Upsampling from layer 1 reads up to kUpsampleBorder[1] pixels around the block.
  static_assert(kUpsampleBorder[1] <= kCellSize,
                "the upsampling border of layer 1 must not exceed one cell");
  const int32_t top = Max(row - 1, grid.first_row), bottom = Min(row + 3, grid.last_row);
  for (int32_t y = top; y < bottom; ++y) {
    for (int32_t x = Max(column - 1, 0); x < Min(column + 3, grid.columns); ++x) {
      stats.r_shown = Min(stats.r_shown, grid.At(x, y)->r_shown);
    }
  }
  for (int layer = 0; layer < 3; ++layer) {
    const int16_t(&border)[4] = reach.border[layer];
    stats.border[layer] = {border[kLeft], border[kRight], border[kTop], border[kBottom]};
  }
  return stats;
}

void FindSmooth(const simd::Kernels& kernels, const Surroundings& surroundings,
                const BlurScale& scale, int32_t row, CellKind* smooth) {
  int16_t low[kMaxRowCells], high[kMaxRowCells], edge[kMaxRowCells];
  uint16_t widest[kMaxRowCells];
  static_assert(kMaxRowCells % simd::kSliceLanes == 0, "kernels write whole lanes");
  kernels.SurroundCells(surroundings.At(surroundings.column, row), surroundings.plane,
                        surroundings.stride, surroundings.around,
                        static_cast<size_t>(surroundings.columns), low, high, widest, edge);
  for (int32_t k = 0; k < surroundings.columns; ++k) {
    smooth[k] = edge[k] > 0 ? CellKind::kMixed : KindOf(scale, low[k], high[k], widest[k]);
  }
}

}  // namespace starfocus
