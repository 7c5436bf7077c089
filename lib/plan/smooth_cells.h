// SPDX-License-Identifier: Apache-2.0
// Smooth cells: finds the cells that are gathered (lib/gather/gather.h) instead of rendered from
// views, stores them, and finds the pixels of a block that belong to them. Also measures the blocks
// of the partition from the cells within their reach.
#ifndef STARFOCUS_LIB_PLAN_SMOOTH_CELLS_H_
#define STARFOCUS_LIB_PLAN_SMOOTH_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/plan/cells.h"
#include "simd/kernels.h"

namespace starfocus {

// For each cell of a stripe, the lowest layer at which the cell can be gathered. Blocks at the
// stored layer or at a higher layer blur the cell without views. Cells with kByViews are always
// rendered from views. Cells with kSlopeMark are blurred with a separate radius for each pixel
// (lib/gather/gather.h). Other cells are blurred with the radius of their middle.
inline constexpr uint8_t kByViews = 3;
inline constexpr uint8_t kSlopeMark = 4;
struct GatherMap {
  uint8_t* cells = nullptr;
  int32_t columns = 0;
  int32_t first_row = 0;  // index in the picture of the first row of cells in memory

  // Returns the cell that contains pixel (x, y) of the picture.
  uint8_t& At(int32_t x, int32_t y) const {
    return cells[static_cast<size_t>(y / kCellSize - first_row) * static_cast<size_t>(columns) +
                 static_cast<size_t>(x / kCellSize)];
  }
  int32_t FirstLayer(int32_t x, int32_t y) const { return At(x, y) & kByViews; }
};

// Returns the rectangle of a layer from which a block is made, including the border that upsampling
// reads.
Rect LayerFrame(const Rect& block, int32_t layer);

// The cells of one block, at the block's layer. A filter blurs some of these cells without
// rendering views. Pixels in the border are treated like the nearest cell of the block, so that a
// block does not depend on its neighbours.
struct BlockCells {
  const GatherMap* map;
  Rect block;  // rectangle of the block in pixels of the picture
  int32_t layer;

  // Returns true if the cell that contains pixel (x, y) of the picture is blurred without views.
  bool IsGathered(int32_t x, int32_t y) const { return map->FirstLayer(x, y) <= layer; }
  // Returns true if the cell is blurred with a single PSF instead of a radius per pixel. IsFlat
  // returns false for cells with kSlopeMark, because kSlopeMark is larger than any layer.
  bool IsFlat(int32_t x, int32_t y) const { return map->At(x, y) <= layer; }

  // Returns the pixels of the layer that belong to the cell at pixel (x, y) of the picture.
  Rect PixelsOf(int32_t x, int32_t y) const;

  // Returns the smallest rectangle of the layer that contains the pixels of all cells for which
  // IsGathered returns `gathered`; an empty rectangle if there is no such cell.
  Rect BoundsOf(bool gathered) const;

  // Returns true if all pixels of `part` belong to cells that are blurred without views.
  bool AreGathered(const Rect& part) const;
};

// A rectangle of cells and the cells up to `around` cells away, as planes for the SIMD kernels.
// Cells outside the picture repeat its edge.
struct Surroundings {
  const int16_t* cells;  // first cell of the rectangle in plane 0
  size_t plane, stride;  // distances between planes and between rows of cells
  int32_t column, row, columns, rows;
  int32_t around;

  const int16_t* At(int32_t of_column, int32_t of_row) const {
    return cells + (of_row - row) * static_cast<ptrdiff_t>(stride) + (of_column - column);
  }
};

// Number of samples for a square of `side` cells, including the samples that kernels read beyond
// the square.
constexpr size_t SurroundingSamples(int32_t side, int32_t around) {
  const auto all = static_cast<size_t>(side + 2 * around);
  return simd::kCellPlanes * all * all + 2 * simd::kSliceLanes;
}

// Loads the surroundings of a rectangle of cells, which may extend beyond the picture. The grid
// must contain all rows of the rectangle and its surroundings that lie inside the picture. `scale`
// must be the scale with which the grid was measured. `samples` has SurroundingSamples.
Surroundings LoadSurroundings(const CellGrid& grid, const BlurScale& scale, const Rect& cells,
                              int32_t around, int16_t* samples);

// A cell is called smooth if lib/gather/gather.h can blur the cell without views. All pixels within
// reach of the cell, and nearer pixels that reach the cell, must belong to one surface without
// depth edges. Blur radii have opposite signs in front of and behind the focus. In each cell within
// reach, signed radii must not vary by more than kSlopeRange (kDisparityBits). Farther pixels that
// reach the cell are ignored, because no view shows farther pixels in front of the surface.
//
// If more than two thirds of the variation of signed radii lie within one cell, the variation
// counts as a step. A step must not exceed the larger of half the largest blur radius and
// kSharpSmoothRange, because the surface may be sharp on one side of the step.
//
// A cell is flat, and uses one PSF for all pixels, if the blur varies by at most kSmoothRange. For
// flat cells, a variation of which more than half lies within one cell is a step.
inline constexpr int32_t kSmoothRange = (5 << kDisparityBits) / 4;
inline constexpr int32_t kSlopeRange = 2 << kDisparityBits;
inline constexpr int32_t kSharpSmoothRange = (1 << kDisparityBits) / 8;
enum class CellKind : uint8_t { kMixed, kSloped, kFlat };

// Returns the statistics of the 2x2 cells at (column, row) of the grid.
BlockStats MeasureBlock(const simd::Kernels& kernels, const CellGrid& grid,
                        const Surroundings& surroundings, int32_t column, int32_t row);

// Classifies the cells of one row of the rectangle in `surroundings`; the row has at most
// kMaxRowCells cells. `scale` must be the scale with which the cells were measured.
inline constexpr int32_t kMaxRowCells = 32;
void FindSmooth(const simd::Kernels& kernels, const Surroundings& surroundings,
                const BlurScale& scale, int32_t row, CellKind* smooth);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_SMOOTH_CELLS_H_
