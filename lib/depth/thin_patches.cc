// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/thin_patches.h"

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
void MarkBeside(const ThinCells& cells, const int16_t* map, const Rect& tile, int32_t y,
                uint8_t* beside) {
  const auto at =
      static_cast<size_t>(y) * static_cast<size_t>(cells.width) + static_cast<size_t>(tile.x);
  const ptrdiff_t up = y > tile.y ? -ptrdiff_t{cells.width} : 0;
  const ptrdiff_t down = y + 1 < tile.y + tile.height ? cells.width : 0;
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

Rect ThinCells::CellAt(int32_t column, int32_t row) const {
  const int32_t x = TileBegin(width, columns, column), y = TileBegin(height, rows, row);
  return {x, y, TileBegin(width, columns, column + 1) - x, TileBegin(height, rows, row + 1) - y};
}

ThinCells TakeThinCells(const SweepSetup& setup, Arena* arena) {
  ThinCells cells;
  cells.width = setup.width;
  cells.height = setup.height;
  cells.tiles_per_row = setup.columns;
  cells.tile_width = TilesAlong(setup.width / setup.columns, kCellSide);
  cells.tile_height = TilesAlong(setup.height / setup.rows, kCellSide);
  cells.columns = setup.columns * cells.tile_width;
  cells.rows = setup.rows * cells.tile_height;
  const auto columns = static_cast<size_t>(cells.columns), rows = static_cast<size_t>(cells.rows);
  cells.beside = arena->Take<uint16_t>(columns, rows);
  cells.dense = arena->Take<uint8_t>(columns, rows);
  cells.thin = arena->Take<uint8_t>(columns, rows);
  return cells;
}

void CountBeside(const ThinCells& cells, const int16_t* map, const Rect& tile, int32_t index) {
  ForCells(cells, index, [&](const Rect&, int32_t cell) { cells.beside[cell] = 0; });
  const int32_t first = index % cells.tiles_per_row * cells.tile_width;
  for (int32_t k = 0; k < cells.tile_height; ++k) {
    const int32_t row = index / cells.tiles_per_row * cells.tile_height + k;
    const Rect left = cells.CellAt(first, row);
    uint16_t* to = cells.beside + static_cast<ptrdiff_t>(row) * cells.columns + first;
    for (int32_t y = left.y; y < left.y + left.height; ++y) {
      uint8_t beside[kMostTileSide];
      MarkBeside(cells, map, tile, y, beside);
      int32_t x = 0;
      for (int32_t column = 0; column < cells.tile_width; ++column) {
        const int32_t end = TileBegin(cells.width, cells.columns, first + column + 1) - tile.x;
        for (; x < end; ++x) to[column] = static_cast<uint16_t>(to[column] + beside[x]);
      }
    }
  }
}

void FindThin(const ThinCells& cells, int32_t percent) {
  const Rect all = {0, 0, cells.columns, cells.rows};
  const auto number = [&](int32_t column, int32_t row) { return row * cells.columns + column; };
  const auto around = [&](int32_t column, int32_t row, int32_t reach) {
    return Clipped(Around(column, row, reach), cells.columns, cells.rows);
  };
  ForPixels(all, [&](int32_t column, int32_t row) {
    int32_t beside = 0, area = 0;
    ForPixels(around(column, row, 1), [&](int32_t x, int32_t y) {
      const Rect rect = cells.CellAt(x, y);
      beside += cells.beside[number(x, y)];
      area += rect.width * rect.height;
    });
    cells.dense[number(column, row)] = 100 * beside >= percent * area && beside > 0;
  });
  ForPixels(all, [&](int32_t column, int32_t row) {
    cells.thin[number(column, row)] =
        AnyPixel(around(column, row, kReach),
                 [&](int32_t x, int32_t y) { return cells.dense[number(x, y)] != 0; });
  });
}

}  // namespace starfocus
