// SPDX-License-Identifier: Apache-2.0
// Which cells are gathered (lib/filter/gather.h) instead of refocused by views, and what of a block
// at its layer they are.
#ifndef STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_
#define STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/plan/block_stats.h"

namespace starfocus {

// Of each cell of a stripe, the lowest layer at which it can be gathered: blocks of that layer and
// of those above it do. kByViews: no block does. Cells that have kSlopeMark besides are gathered
// with the radius of each pixel (lib/filter/slope.h), others with that of their middle.
inline constexpr uint8_t kByViews = 3;
inline constexpr uint8_t kSlopeMark = 4;
struct GatherMap {
  uint8_t* cells = nullptr;
  int32_t columns = 0;
  int32_t first_row = 0;  // of the cells of the picture

  // The cell that holds pixel (x, y) of the picture.
  uint8_t& At(int32_t x, int32_t y) const {
    return cells[static_cast<size_t>(y / kCellSize - first_row) * static_cast<size_t>(columns) +
                 static_cast<size_t>(x / kCellSize)];
  }
  int32_t FirstLayer(int32_t x, int32_t y) const { return At(x, y) & kByViews; }
};

// The part of a layer that a block makes its pixels of: with the margin that upsampling reads.
Rect LayerFrame(const Rect& block, int32_t layer);

// The cells of a block that gathers, at its layer. What lies in the margin goes the way of the
// nearest cell of the block, so that a block is the same whatever lies around it.
struct BlockCells {
  const GatherMap* map;
  Rect block;  // in pixels of the picture
  int32_t layer;

  // Whether the cell that holds pixel (x, y) of the picture is gathered.
  bool IsGathered(int32_t x, int32_t y) const { return map->FirstLayer(x, y) <= layer; }
  // Whether it is gathered with one kernel and not with the radius of each pixel: kSlopeMark is
  // beyond all layers.
  bool IsFlat(int32_t x, int32_t y) const { return map->At(x, y) <= layer; }

  // The pixels of the layer that belong to the cell of the block at (x, y) in the picture.
  Rect PixelsOf(int32_t x, int32_t y) const;

  // Whether all pixels of a part of the layer belong to gathered cells.
  bool AreGathered(const Rect& part) const;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_GATHERED_CELLS_H_
