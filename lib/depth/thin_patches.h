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

// Sides of patches are between 0.5 and 1.5 times kPatchSide pixels, except in pictures that are
// narrower or lower than one such patch.
inline constexpr int32_t kPatchSide = 16, kMostPatchSide = 3 * kPatchSide / 2;

// The patches of a map, and their properties row by row. Each tile is divided into patches of about
// kPatchSide x kPatchSide pixels. A mirrored picture has mirrored patches.
struct ThinPatches {
  int32_t width, height;  // Size of the picture.
  int32_t columns, rows;  // Numbers of patches.
  int32_t tiles_per_row;
  int32_t tile_width, tile_height;  // Size of a tile in patches.
  uint16_t* beside;                 // Numbers of pixels that are next to much nearer pixels.
  // True if many pixels of the patch and of its neighbours are next to much nearer pixels.
  uint8_t* dense;
  uint8_t* thin;  // True if the patch is near a dense patch.

  // Returns the pixels of a patch.
  Rect PatchAt(int32_t column, int32_t row) const;
};
ThinPatches TakeThinPatches(const SweepSetup& setup, Arena* arena);

// Fills patches.beside for the patches of tile `index`. `tile` is the rectangle of the tile; no
// pixel outside the rectangle is read.
void CountBeside(const ThinPatches& patches, const int16_t* map, const Rect& tile, int32_t index);

// Smallest percentage of pixels next to much nearer pixels, counted in a patch and its eight
// neighbours, that makes the patch dense. The percentage kThinGiven applies to given maps. Near
// crossing wires, 15 % of the pixels are next to much nearer pixels, or 20 % if the rows of the map
// are displaced. In a head of hair, up to 45 % of the pixels are next to much nearer pixels. The
// percentage kThinFound applies to maps that are estimated from the views, whose rows are not
// displaced.
inline constexpr int32_t kThinGiven = 24, kThinFound = 17;

// Fills patches.dense and patches.thin. Call FindThin after CountBeside has been called for all
// tiles.
void FindThin(const ThinPatches& patches, int32_t percent);

// Calls act(rectangle, number) for each patch of tile `index`.
template <class Act>
void ForPatches(const ThinPatches& patches, int32_t index, const Act& act) {
  const int32_t left = index % patches.tiles_per_row * patches.tile_width;
  const int32_t top = index / patches.tiles_per_row * patches.tile_height;
  ForPixels({left, top, patches.tile_width, patches.tile_height}, [&](int32_t column, int32_t row) {
    act(patches.PatchAt(column, row), row * patches.columns + column);
  });
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_THIN_CELLS_H_
