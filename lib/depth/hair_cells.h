// SPDX-License-Identifier: Apache-2.0
// Where a map has large depth edges, and the two surfaces that meet there, by cells of 4 x 4
// pixels.
#ifndef STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_
#define STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/carver.h"
#include "lib/depth/colour_map.h"
#include "lib/depth/colour_pyramid.h"

namespace starfocus {

// Surfaces are looked for within this many cells.
inline constexpr int32_t kSurfaceReach = 10;

struct HairCells {
  int32_t columns, rows;
  // Farthest and nearest disparity off ramps: first of the cell, then within kSurfaceReach.
  int16_t *low, *high;
  // Of all of its pixels.
  int16_t *farthest, *nearest;
  uint8_t* marks;
  int32_t* line;  // scratch

  // There are two surfaces within kSurfaceReach.
  static constexpr uint8_t kHasEdge = 1;
  // There are, and no near pixel within a cell: only far ones.
  static constexpr uint8_t kIsFar = 2;
  // There are near pixels, and far ones 2 to 4 cells away: it lies a little inside an outline.
  static constexpr uint8_t kIsInside = 4;
  // There is hair that the map has as a closed outline.
  static constexpr uint8_t kHasHair = 8;

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(columns) + static_cast<size_t>(x);
  }
  bool IsNear(size_t cell, int32_t disparity) const {
    return (marks[cell] & kHasEdge) != 0 && 2 * disparity > low[cell] + high[cell];
  }
};
HairCells TakeHairCells(int32_t width, int32_t height, Carver* carver);

// Whether a cell with these marks may have near pixels.
inline bool MayHaveNear(uint8_t marks) { return marks != 0 && (marks & HairCells::kIsFar) == 0; }

// Writes the disparities of a cell.
void MeasureHairCell(const ColourMap& map, int32_t column, int32_t row, const HairCells& cells);

// Marks all cells when they are measured. Returns false if there are no edges.
bool MarkEdges(const HairCells& cells);

// Marks the cells around which so much looks far of what the map says is near: `near` has the
// number of near pixels of each cell, `far` how many of them look far, times 256. Both are
// overwritten. Returns false if there are none.
bool MarkHair(const HairCells& cells, int32_t* near, int32_t* far);

// Returns true if one of the cells that touch the rectangle has hair.
bool HasHair(const HairCells& cells, const Rect& rect);

// Calls act(column, row) for the cells whose first pixel lies in the tile.
template <class Act>
void ForHairCells(const Rect& tile, const Act& act) {
  const auto begin = [](int32_t pixel) { return (pixel + kHairCell - 1) / kHairCell; };
  for (int32_t row = begin(tile.y); row < begin(tile.y + tile.height); ++row) {
    for (int32_t column = begin(tile.x); column < begin(tile.x + tile.width); ++column) {
      act(column, row);
    }
  }
}

// The pixels of a cell.
inline Rect HairCellAt(const EstimatePlan& plan, int32_t column, int32_t row) {
  const int32_t x = column * kHairCell, y = row * kHairCell;
  return {x, y, Min(kHairCell, plan.width - x), Min(kHairCell, plan.height - y)};
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_HAIR_CELLS_H_
