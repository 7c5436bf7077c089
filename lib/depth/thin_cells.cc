// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/thin_cells.h"

#include <algorithm>
#include <cstring>

#include "lib/base/fixed.h"
#include "simd/disparities.h"

namespace starfocus {
namespace {

// Largest step of disparity between pixels of one surface, in fixed point (kDisparityBits).
// lib/matting uses an equal value.
constexpr int32_t kStep = 5 << kDisparityBits;
// All cells within kReach cells of a dense cell are marked as thin, because the rim of a thin
// structure has fewer strands.
constexpr int32_t kReach = 6;

// Marks the pixels of row y of a tile that are next to much nearer pixels of the tile.
void MarkBeside(const ThinGrid& grid, const int16_t* map, const Rect& tile, int32_t y,
                uint8_t* beside) {
  const auto at =
      static_cast<size_t>(y) * static_cast<size_t>(grid.width) + static_cast<size_t>(tile.x);
  const ptrdiff_t up = y > tile.y ? -ptrdiff_t{grid.width} : 0;
  const ptrdiff_t down = y + 1 < tile.y + tile.height ? grid.width : 0;
  const int16_t* from = map + at;
  int16_t row[kMostTileSide + 2];
  std::memcpy(row + 1, from, static_cast<size_t>(tile.width) * sizeof(*row));
  row[0] = from[0];
  row[tile.width + 1] = from[tile.width - 1];
  for (ptrdiff_t x = 0; x < tile.width; ++x) {
    const int16_t here = row[x + 1];
    const int16_t across = std::max(row[x], row[x + 2]);
    const int16_t nearest = std::max(across, std::max(from[x + up], from[x + down]));
    beside[x] = (here != simd::kNoSurface) & (nearest - here > kStep);
  }
}

}  // namespace

Rect ThinGrid::CellAt(int32_t column, int32_t row) const {
  const int32_t x = TileBegin(width, columns, column), y = TileBegin(height, rows, row);
  return {x, y, TileBegin(width, columns, column + 1) - x, TileBegin(height, rows, row + 1) - y};
}

ThinGrid GridOf(const SweepSetup& setup) {
  ThinGrid grid;
  grid.width = setup.width;
  grid.height = setup.height;
  grid.tile_columns = setup.columns;
  grid.tile_width = TilesAlong(setup.width / setup.columns, kCellSide);
  grid.tile_rows = TilesAlong(setup.height / setup.rows, kCellSide);
  grid.columns = setup.columns * grid.tile_width;
  grid.rows = setup.rows * grid.tile_rows;
  return grid;
}

ThinCells TakeThinCells(const ThinGrid& grid, Arena* arena) {
  const auto cells = static_cast<size_t>(grid.Cells());
  ThinCells taken;
  taken.beside = arena->Take<uint16_t>(cells);
  taken.dense = arena->Take<uint8_t>(cells);
  taken.thin = arena->Take<uint8_t>(cells);
  return taken;
}

void CountBeside(const ThinGrid& grid, const int16_t* map, const Rect& tile, int32_t index,
                 const ThinCells& cells) {
  ForCells(grid, index, [&](const Rect&, int32_t cell) { cells.beside[cell] = 0; });
  const int32_t first = index % grid.tile_columns * grid.tile_width;
  for (int32_t k = 0; k < grid.tile_rows; ++k) {
    const int32_t row = index / grid.tile_columns * grid.tile_rows + k;
    const Rect left = grid.CellAt(first, row);
    uint16_t* to = cells.beside + static_cast<ptrdiff_t>(row) * grid.columns + first;
    for (int32_t y = left.y; y < left.y + left.height; ++y) {
      uint8_t beside[kMostTileSide];
      MarkBeside(grid, map, tile, y, beside);
      int32_t x = 0;
      for (int32_t column = 0; column < grid.tile_width; ++column) {
        const int32_t end = TileBegin(grid.width, grid.columns, first + column + 1) - tile.x;
        for (; x < end; ++x) to[column] = static_cast<uint16_t>(to[column] + beside[x]);
      }
    }
  }
}

void FindThin(const ThinGrid& grid, int32_t percent, const ThinCells& cells) {
  const auto for_each = [&](const auto& act) {
    for (int32_t row = 0; row < grid.rows; ++row) {
      for (int32_t column = 0; column < grid.columns; ++column) {
        act(column, row, row * grid.columns + column);
      }
    }
  };
  for_each([&](int32_t column, int32_t row, int32_t cell) {
    int32_t beside = 0, area = 0;
    ForAround(grid, column, row, 1, [&](int32_t x, int32_t y, int32_t other) {
      const Rect rect = grid.CellAt(x, y);
      beside += cells.beside[other];
      area += rect.width * rect.height;
    });
    cells.dense[cell] = 100 * beside >= percent * area && beside > 0;
  });
  for_each([&](int32_t column, int32_t row, int32_t cell) {
    uint8_t thin = 0;
    ForAround(grid, column, row, kReach,
              [&](int32_t, int32_t, int32_t other) { thin |= cells.dense[other]; });
    cells.thin[cell] = thin;
  });
}

}  // namespace starfocus
