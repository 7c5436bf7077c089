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
// All patches within kReach patches of a dense patch are marked as thin, because the rim of a thin
// structure has fewer strands.
constexpr int32_t kReach = 6;

// Marks the pixels of row y of a tile that are next to much nearer pixels of the tile.
void MarkBeside(const ThinPatches& patches, const int16_t* map, const Rect& tile, int32_t y,
                uint8_t* beside) {
  const auto at =
      static_cast<size_t>(y) * static_cast<size_t>(patches.width) + static_cast<size_t>(tile.x);
  const ptrdiff_t up = y > tile.y ? -ptrdiff_t{patches.width} : 0;
  const ptrdiff_t down = y + 1 < tile.y + tile.height ? patches.width : 0;
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

Rect ThinPatches::PatchAt(int32_t column, int32_t row) const {
  const int32_t x = TileBegin(width, columns, column), y = TileBegin(height, rows, row);
  return {x, y, TileBegin(width, columns, column + 1) - x, TileBegin(height, rows, row + 1) - y};
}

ThinPatches TakeThinPatches(const SweepSetup& setup, Arena* arena) {
  ThinPatches patches;
  patches.width = setup.width;
  patches.height = setup.height;
  patches.tiles_per_row = setup.columns;
  patches.tile_width = TilesAlong(setup.width / setup.columns, kPatchSide);
  patches.tile_height = TilesAlong(setup.height / setup.rows, kPatchSide);
  patches.columns = setup.columns * patches.tile_width;
  patches.rows = setup.rows * patches.tile_height;
  const auto columns = static_cast<size_t>(patches.columns),
             rows = static_cast<size_t>(patches.rows);
  patches.beside = arena->Take<uint16_t>(columns, rows);
  patches.dense = arena->Take<uint8_t>(columns, rows);
  patches.thin = arena->Take<uint8_t>(columns, rows);
  return patches;
}

void CountBeside(const ThinPatches& patches, const int16_t* map, const Rect& tile, int32_t index) {
  ForPatches(patches, index, [&](const Rect&, int32_t patch) { patches.beside[patch] = 0; });
  const int32_t first = index % patches.tiles_per_row * patches.tile_width;
  for (int32_t k = 0; k < patches.tile_height; ++k) {
    const int32_t row = index / patches.tiles_per_row * patches.tile_height + k;
    const Rect left = patches.PatchAt(first, row);
    uint16_t* to = patches.beside + static_cast<ptrdiff_t>(row) * patches.columns + first;
    for (int32_t y = left.y; y < left.y + left.height; ++y) {
      uint8_t beside[kMostTileSide];
      MarkBeside(patches, map, tile, y, beside);
      int32_t x = 0;
      for (int32_t column = 0; column < patches.tile_width; ++column) {
        const int32_t end = TileBegin(patches.width, patches.columns, first + column + 1) - tile.x;
        for (; x < end; ++x) to[column] = static_cast<uint16_t>(to[column] + beside[x]);
      }
    }
  }
}

void FindThin(const ThinPatches& patches, int32_t percent) {
  const Rect all = {0, 0, patches.columns, patches.rows};
  const auto number = [&](int32_t column, int32_t row) { return row * patches.columns + column; };
  const auto around = [&](int32_t column, int32_t row, int32_t reach) {
    return Clipped(Around(column, row, reach), patches.columns, patches.rows);
  };
  ForPixels(all, [&](int32_t column, int32_t row) {
    int32_t beside = 0, area = 0;
    ForPixels(around(column, row, 1), [&](int32_t x, int32_t y) {
      const Rect rect = patches.PatchAt(x, y);
      beside += patches.beside[number(x, y)];
      area += rect.width * rect.height;
    });
    patches.dense[number(column, row)] = 100 * beside >= percent * area && beside > 0;
  });
  ForPixels(all, [&](int32_t column, int32_t row) {
    patches.thin[number(column, row)] =
        AnyPixel(around(column, row, kReach),
                 [&](int32_t x, int32_t y) { return patches.dense[number(x, y)] != 0; });
  });
}

}  // namespace starfocus
