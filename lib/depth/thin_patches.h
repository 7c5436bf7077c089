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

// Sides of cells are between 0.5 and 1.5 times kCellSide pixels, except in pictures that are
// narrower or lower than one such cell.
inline constexpr int32_t kCellSide = 16, kMostCellSide = 3 * kCellSide / 2;

// The cells of a map, and their properties row by row. Each tile is divided into cells of about
// kCellSide x kCellSide pixels. A mirrored picture has mirrored cells.
struct ThinCells {
  int32_t width, height;  // Size of the picture.
  int32_t columns, rows;  // Numbers of cells.
  int32_t tiles_per_row;
  int32_t tile_width, tile_height;  // Size of a tile in cells.
  uint16_t* beside;                 // Numbers of pixels that are next to much nearer pixels.
  // True if many pixels of the cell and of its neighbours are next to much nearer pixels.
  uint8_t* dense;
  uint8_t* thin;  // True if the cell is near a dense cell.

  // Returns the pixels of a cell.
  Rect CellAt(int32_t column, int32_t row) const;
};
ThinCells TakeThinCells(const SweepSetup& setup, Arena* arena);

// Fills cells.beside for the cells of tile `index`. `tile` is the rectangle of the tile; no pixel
// outside the rectangle is read.
void CountBeside(const ThinCells& cells, const int16_t* map, const Rect& tile, int32_t index);

// Smallest percentage of pixels next to much nearer pixels, counted in a cell and its eight
// neighbours, that makes the cell dense. The percentage kThinGiven applies to given maps. Near
// crossing wires, 15 % of the pixels are next to much nearer pixels, or 20 % if the rows of the map
// are displaced. In a head of hair, up to 45 % of the pixels are next to much nearer pixels. The
// percentage kThinFound applies to maps that are estimated from the views, whose rows are not
// displaced.
inline constexpr int32_t kThinGiven = 24, kThinFound = 17;

// Fills cells.dense and cells.thin. Call FindThin after CountBeside has been called for all tiles.
void FindThin(const ThinCells& cells, int32_t percent);

// Calls act(rectangle, number) for each cell of tile `index`.
template <class Act>
void ForCells(const ThinCells& cells, int32_t index, const Act& act) {
  const int32_t left = index % cells.tiles_per_row * cells.tile_width;
  const int32_t top = index / cells.tiles_per_row * cells.tile_height;
  ForPixels({left, top, cells.tile_width, cells.tile_height}, [&](int32_t column, int32_t row) {
    act(cells.CellAt(column, row), row * cells.columns + column);
  });
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
