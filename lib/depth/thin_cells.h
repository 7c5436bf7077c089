// SPDX-License-Identifier: Apache-2.0
// Finds the thin structures of a map (hair, twigs, grass) by the number of pixels that are next to
// much nearer pixels. Nearly every pixel of a thin structure is a mixture that no other view shows.
// In thin structures, a search for the best fit therefore gives arbitrary results.
#ifndef STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
#define STARFOCUS_LIB_DEPTH_THIN_CELLS_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/setup.h"

namespace starfocus {

// Sides of cells are between 0.5 and 1.5 times kCellSide pixels. Cells next to other cells have at
// least kLeastCellSide pixels in this direction. No cell has a larger width or height than
// kMostCellSide.
inline constexpr int32_t kCellSide = 16, kLeastCellSide = kCellSide / 2;
inline constexpr int32_t kMostCellSide = 3 * kCellSide / 2 + 1;

// Grid of cells over a map. Each tile is divided into cells of about kCellSide x kCellSide pixels.
// A mirrored picture has mirrored cells.
struct ThinGrid {
  int32_t width, height;          // Size of the picture.
  int32_t columns, rows;          // Numbers of cells.
  int32_t tile_columns;           // Number of tiles in a row.
  int32_t tile_width, tile_rows;  // Size of a tile in cells.

  int32_t Cells() const { return columns * rows; }
  Rect CellAt(int32_t column, int32_t row) const;
};
ThinGrid GridOf(const SweepSetup& setup);

// Properties of the cells of a map, row by row.
struct ThinCells {
  uint16_t* beside;  // number of pixels that are next to much nearer pixels
  // True if many pixels of the cell and of its neighbours are next to much nearer pixels.
  uint8_t* dense;
  uint8_t* thin;  // true if the cell is near a dense cell
};
ThinCells TakeThinCells(const ThinGrid& grid, Arena* arena);

// Fills cells.beside for the cells of tile `index`. `tile` is the rectangle of the tile; no pixel
// outside the rectangle is read.
void CountBeside(const ThinGrid& grid, const int16_t* map, const Rect& tile, int32_t index,
                 const ThinCells& cells);

// Smallest percentage of pixels next to much nearer pixels, counted in a cell and its eight
// neighbours, that makes the cell dense. The percentage kThinGiven applies to given maps. Near
// crossing wires, 15 % of the pixels are next to much nearer pixels, or 20 % if the rows of the map
// are displaced. In a head of hair, up to 45 % of the pixels are next to much nearer pixels. The
// percentage kThinFound applies to maps that are estimated from the views, whose rows are not
// displaced.
inline constexpr int32_t kThinGiven = 24, kThinFound = 17;

// Fills cells.dense and cells.thin. Call FindThin after CountBeside has been called for all tiles.
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

// Calls act(column, row, number) for each cell within `reach` cells of cell (column, row).
template <class Act>
void ForAround(const ThinGrid& grid, int32_t column, int32_t row, int32_t reach, const Act& act) {
  const int32_t right = Min(column + reach, grid.columns - 1);
  const int32_t bottom = Min(row + reach, grid.rows - 1);
  for (int32_t y = Max(row - reach, 0); y <= bottom; ++y) {
    for (int32_t x = Max(column - reach, 0); x <= right; ++x) act(x, y, y * grid.columns + x);
  }
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
