// SPDX-License-Identifier: Apache-2.0
// Where a map has thin structure (hair, twigs, grass), by how many of its pixels lie beside much
// nearer ones. Nearly every pixel is a mixture there, and no view shows a mixture of the same kind:
// a search for what fits best finds anything.
#ifndef STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
#define STARFOCUS_LIB_DEPTH_THIN_CELLS_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/estimate_plan.h"

namespace starfocus {

// Cells are no wider and no higher than this.
inline constexpr int32_t kMostCellSide = 25;

// Each tile is divided into cells of about 16 x 16 pixels, a mirrored picture into mirrored ones.
struct ThinGrid {
  int32_t width, height;          // of the picture
  int32_t columns, rows;          // of cells
  int32_t tile_columns;           // of tiles
  int32_t tile_width, tile_rows;  // cells of a tile, across and down

  int32_t Cells() const { return columns * rows; }
  Rect CellAt(int32_t column, int32_t row) const;
};
ThinGrid GridOf(const EstimatePlan& plan);

// What is known of the cells of a map, row by row.
struct ThinCells {
  uint16_t* beside;  // how many of its pixels lie beside much nearer ones
  uint8_t* dense;    // whether they do so densely in it and the cells around
  uint8_t* thin;     // whether a cell within reach is dense
};
ThinCells TakeThinCells(const ThinGrid& grid, Arena* arena);

// Counts the pixels of the cells of tile `index`, the whole of which is the rectangle `tile`. No
// pixel beyond it is read.
void CountBeside(const ThinGrid& grid, const int16_t* map, const Rect& tile, int32_t index,
                 const ThinCells& cells);

// Of the pixels of a cell and the eight around it so many percent lie beside nearer ones where
// strands are dense. A given map is thin from kThinGiven on: crossing wires have 15, 20 if the rows
// of their map are moved, and a head of hair up to 45. In what is found rows are no longer moved.
inline constexpr int32_t kThinGiven = 24, kThinFound = 17;

// Finds the thin cells when those of all tiles are counted.
void FindThin(const ThinGrid& grid, int32_t percent, const ThinCells& cells);

// Calls act(rectangle, number) for each cell of tile `index`.
template <class Act>
void ForCells(const ThinGrid& grid, int32_t index, const Act& act) {
  const int32_t left = index % grid.tile_columns * grid.tile_width;
  const int32_t top = index / grid.tile_columns * grid.tile_rows;
  for (int32_t row = top; row < top + grid.tile_rows; ++row) {
    for (int32_t column = left; column < left + grid.tile_width; ++column) {
      act(grid.CellAt(column, row), row * grid.columns + column);
    }
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
