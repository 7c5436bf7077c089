// SPDX-License-Identifier: Apache-2.0
// Analysis of blocks of variable size (paper, V-A). This module measures the blur of 8x8 cells and
// combines cells into blocks. The partition (lib/plan/partition.h) chooses blocks according to
// these statistics.
#ifndef STARFOCUS_LIB_PLAN_CELLS_H_
#define STARFOCUS_LIB_PLAN_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

inline constexpr int32_t kCellSize = 8;

// Content of a cell or block at layer 0, from which the timing model predicts the work of
// rendering. Content is counted along rows or along columns, in units of 1 / kContentOne. Each step
// of disparity between neighbouring pixels contributes to the content.
inline constexpr int32_t kContentOne = 16;
struct Content {
  // Number of runs of equal disparity that steps within a surface start. If several steps start one
  // run, each step counts as a fraction of a run.
  uint32_t slopes;
  uint32_t edges;  // runs started by depth edges
  // Pixels that depth edges uncover in the outermost view, at most 8 for each edge.
  uint32_t gaps;
};

// Statistics of a cell. Blur radii have kDisparityBits fractional bits: 128 px are 8192. All
// disparities are disparities without the range in focus (FocusRange::WithoutRange), so the blur
// radius depends on their distance from the far end of the focus, and steps inside the range in
// focus are no depth edges.
struct Cell {
  uint16_t r_min, r_max;  // smallest radius, rounded down; largest radius, rounded up
  // Smallest blur radius of all surfaces that the pixels show, rounded down. The nearer surface of
  // a depth edge is included, because the pixels next to the edge may show a part of this surface.
  uint16_t r_shown : 15;
  uint16_t has_edge : 1;  // 1: a depth edge lies inside the cell or at one of its sides.
  int16_t low, high;      // Range of disparities without the range in focus, kDisparityBits.
  // Number of pixels that the cell splats to the left, right, top and bottom, measured from the
  // opposite edge of the cell. `inside` counts the pixels from each side to the innermost pixel
  // that splats beyond the side.
  uint8_t beyond[4];
  uint8_t inside[4];
  // Members of Content, counted along rows and along columns.
  uint16_t slopes[2], edges[2], gaps[2];

  // Number of pixels that the cell splats beyond a side. Cells with a result <= 0 do not splat
  // beyond the side.
  int32_t Reach(size_t side) const { return beyond[side] - kCellSize; }
};

enum Side { kLeft, kRight, kTop, kBottom };

// Parameters of the lens that determine the blur radius.
struct BlurScale {
  FocusRange focus;  // d_t
  int64_t step;      // u_t, the relative aperture, kStepBits.

  // Converts |d - d_t| (kDisparityBits) to a blur radius, rounded down.
  int32_t Radius(int32_t distance) const {
    return static_cast<int32_t>(Checked(ranges::kRadius, (step * distance) >> kStepBits));
  }
  // Converts |d - d_t| to a blur radius, rounded up. The radius is 0 only if d equals d_t.
  int32_t RadiusAbove(int32_t distance) const {
    return static_cast<int32_t>((step * distance + (int64_t{1} << kStepBits) - 1) >> kStepBits);
  }
};

// Returns the number of pixels that a blur of radius r (kDisparityBits) reaches, including half a
// pixel for rounding.
constexpr int32_t ReachOf(int32_t r) {
  return (r + (3 << kDisparityBits) / 2 - 1) >> kDisparityBits;
}

// Number of pixels of the layer that rendering reads beyond the reach of the blur, because a
// subaperture uses the neighbours of a pixel as well.
inline constexpr int32_t kRenderBorder = 1;

// Grid of the cells of some rows of the picture, over its whole width. Positions outside the
// picture use the nearest cell, because the picture repeats its edge there.
struct CellGrid {
  Cell* cells = nullptr;
  int32_t columns = 0;    // Number of columns of cells in the whole picture.
  int32_t rows = 0;       // Number of rows of cells in the whole picture.
  int32_t first_row = 0;  // Rows [first_row, last_row) of cells are in memory.
  int32_t last_row = 0;

  Cell* At(int32_t column, int32_t row) const {
    return cells + static_cast<size_t>(row - first_row) * static_cast<size_t>(columns) + column;
  }
};

// Adds the content of a cell to *sum.
void AddCell(const Cell& cell, Content (*sum)[2]);

// Width in pixels of the border around a cell that the measurement of the cell reads.
inline constexpr int32_t kCellBorder = 1;

// Measures the cells of some columns of one row of the grid, and writes them to `cells`.
void MeasureCells(const simd::Kernels& kernels, const Input& input, const BlurScale& scale,
                  int32_t row, const Range& columns, Cell* cells);

// Largest variation of blur radii (kDisparityBits) of a surface that shows light beyond white. A
// lamp is much brighter than the surface around it, so that the light which a blur of a slightly
// different radius spreads around it is visible.
inline constexpr int32_t kLampRange = (1 << kDisparityBits) / 4;

// Returns true if the blur radii of the pixels of a rectangle vary by more than kLampRange.
bool IsUneven(const Input& input, const BlurScale& scale, const Rect& rect);

// Number of pixels of a layer that upsampling by two reads beyond each side of a block.
inline constexpr int32_t kUpBorder = 2;

// Returns the number of pixels that a block at layer L renders beyond each side. Upsampling from
// layer to layer reads the pixels of this border.
constexpr int32_t UpsampleBorder(int32_t layer) {
  return layer == 0 ? 0 : (UpsampleBorder(layer - 1) + 1) / 2 + kUpBorder;
}

// UpsampleBorder of each layer, converted to pixels of the picture.
inline constexpr int16_t kUpsampleBorder[3] = {0, UpsampleBorder(1) << 1, UpsampleBorder(2) << 2};

// Statistics of a block. The members r_max and has_edge include all pixels that splat into the
// block. The member r_min includes only the cells of the block, and r_shown includes the cells
// around the block as well. `border` contains, for each layer, the distance beyond which no pixel
// splats into the block with its border.
struct BlockStats {
  int32_t r_min, r_shown, r_max;
  bool has_edge;
  Border border[3];
  Content content[2];  // content of the pixels in the block, along rows and along columns
};

// Returns the statistics of a block that consists of four smaller blocks with side `side`, the
// children, in z-order. Children outside the picture are null.
BlockStats MergeBlocks(const BlockStats* const children[4], int32_t side);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_CELLS_H_
