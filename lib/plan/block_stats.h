// SPDX-License-Identifier: Apache-2.0
// Variable-size block analysis (paper, V-A): what 8x8 cells know of the blur, and blocks made of
// them.
#ifndef STARFOCUS_LIB_PLAN_BLOCK_STATS_H_
#define STARFOCUS_LIB_PLAN_BLOCK_STATS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

inline constexpr int32_t kCellSize = 8;

// What line scans meet in a cell or block at layer 0, along rows or along columns, in units of
// 1 / kContentOne: every step from pixel to pixel counts.
inline constexpr int32_t kContentOne = 16;
struct Content {
  uint32_t slopes;  // runs that steps within a surface start; a fraction where it takes several
  uint32_t edges;   // runs that depth edges start
  uint32_t gaps;    // pixels that depth edges uncover in the outermost view, 8 at most each
};

// Blur radii carry kDisparityBits fractional bits: 128 px are 8192.
struct Cell {
  uint16_t r_min, r_max;  // rounded down, up
  // The least blur of what pixels show, rounded down: beside a depth edge they also show a part of
  // the nearer surface.
  uint16_t r_shown : 15;
  uint16_t has_edge : 1;  // a depth edge inside or at a side
  int16_t low, high;      // disparities, kDisparityBits
  // How many pixels from its right, left, bottom and top edge on the cell splats to the left,
  // right, top and bottom, and how deep inside lie the pixels that splat beyond it.
  uint8_t span[4];
  uint8_t inside[4];
  uint16_t slopes[2], edges[2], gaps[2];  // Content along rows and along columns

  // How many pixels beyond an edge it splats; <= 0: not at all.
  int32_t Reach(size_t side) const { return span[side] - kCellSize; }
};

enum Side { kLeft, kRight, kTop, kBottom };

// The lens as the analysis sees it.
struct BlurScale {
  int32_t focus;  // kDisparityBits
  int64_t step;   // u_t, kStepBits

  // |d - d_t| (kDisparityBits) to a blur radius, rounded down.
  int32_t Radius(int32_t distance) const {
    return static_cast<int32_t>(Checked(ranges::kRadius, (step * distance) >> kStepBits));
  }
  // The blur radius rounded up, which is 0 only for what is in focus.
  int32_t RadiusAbove(int32_t distance) const {
    return static_cast<int32_t>((step * distance + (int64_t{1} << kStepBits) - 1) >> kStepBits);
  }
};

// Pixels that blur of radius r (kDisparityBits) reaches, with half a pixel of rounding.
constexpr int32_t ReachOf(int32_t r) {
  return (r + (3 << kDisparityBits) / 2 - 1) >> kDisparityBits;
}

// Pixels of the level around what blur reaches that are rendered, too, for the neighbour of a
// subaperture.
inline constexpr int32_t kRenderBorder = 1;

// A grid of cells over rows of the picture, all columns. Positions outside the picture, and only
// those, take the nearest cell, whose edge the picture repeats.
struct CellGrid {
  Cell* cells = nullptr;
  int32_t columns = 0;    // of the picture
  int32_t rows = 0;       // of the picture
  int32_t first_row = 0;  // rows [first_row, last_row) are stored
  int32_t last_row = 0;

  Cell* At(int32_t column, int32_t row) const {
    return cells + static_cast<size_t>(row - first_row) * static_cast<size_t>(columns) + column;
  }
};

// Adds what line scans meet in a cell.
void AddCell(const Cell& cell, Content (*sum)[2]);

// Pixels around a cell that it is measured with.
inline constexpr int32_t kCellBorder = 1;

// Cells at columns [first, last) of a row of the grid.
struct CellRange {
  int32_t row, first, last;
  Cell* cells;
};

// Measures cells; the window is at layer 0.
void MeasureCells(const simd::Kernels& kernels, const Window& window, const BlurScale& scale,
                  const CellRange& range);

// Pixels of a layer around what twice as many become that upsampling reads.
inline constexpr int32_t kUpBorder = 2;

// Pixels that a block refocused at layer L renders beyond its sides, because upsampling reads them
// from layer to layer.
constexpr int32_t LayerMargin(int32_t layer) {
  return layer == 0 ? 0 : (LayerMargin(layer - 1) + 1) / 2 + kUpBorder;
}

// The same in pixels of the picture.
inline constexpr int16_t kLayerMargin[3] = {0, LayerMargin(1) << 1, LayerMargin(2) << 2};

// What a block knows: radii of the pixels inside and (but for r_min and r_shown) of those that
// splat into it, and for each layer the border beyond which no pixel splats into the block and its
// margin.
struct BlockStats {
  int32_t r_min, r_shown, r_max;
  bool has_edge;
  Border border[3];
  Content content[2];  // of the pixels inside, along rows and along columns
};

// Stats of the block of twice the side `side` made of children in z-order. Children outside the
// picture are null.
BlockStats MergeBlocks(const BlockStats* const children[4], int32_t side);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_BLOCK_STATS_H_
