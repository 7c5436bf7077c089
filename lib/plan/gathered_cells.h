// SPDX-License-Identifier: Apache-2.0
// Stores which cells are gathered (lib/gather/gather.h) instead of rendered from views, and finds
// the pixels of a block that belong to gathered cells.
#ifndef STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_
#define STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/plan/cells.h"

namespace starfocus {

// For each cell of a stripe, the lowest layer at which the cell can be gathered. Blocks at the
// stored layer or at a higher layer blur the cell without views. Cells with kByViews are always
// rendered from views. Cells with kSlopeMark are blurred with a separate radius for each pixel
// (lib/gather/slope.h). Other cells are blurred with the radius of their middle.
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

// Returns the rectangle of a layer from which a block is made, including the margin that upsampling
// reads.
Rect LayerFrame(const Rect& block, int32_t layer);

// The cells of one block, at the block's layer. A filter blurs some of these cells without
// rendering views. Pixels in the margin are treated like the nearest cell of the block, so that a
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

  // Returns true if all pixels of `part` belong to cells that are blurred without views.
  bool AreGathered(const Rect& part) const;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_
