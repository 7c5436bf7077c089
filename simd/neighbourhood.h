// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that examine the cells around a block or a cell: which of them its blur reaches, and
// which of them reach it.
#ifndef STARFOCUS_SIMD_NEIGHBOURHOOD_H_
#define STARFOCUS_SIMD_NEIGHBOURHOOD_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

inline constexpr int16_t kCellPixels = 8;

// Properties of a cell, one plane each. Reaches and insides are in pixels.
enum CellPlane {
  kReachLeft,  // distance beyond each side to which the cell's pixels are splatted
  kReachRight,
  kReachTop,
  kReachBottom,
  // largest distance inside that side of the pixels that reach beyond it, [0, kCellPixels]
  kInsideLeft,
  kInsideRight,
  kInsideTop,
  kInsideBottom,
  kReachPlane,   // largest reach of the cell's blur, to any side
  kNearPlane,    // reach of the blur of its nearest pixels
  kRadiusPlane,  // largest blur radius
  kEdgePlane,    // largest blur radius at depth edges, 0 without edges
  kLowPlane,     // lowest and highest disparity
  kHighPlane,
  kCellPlanes
};

// Planes of a picture's cells, `plane` samples apart, with rows `stride` samples apart.
struct CellPlanes {
  const int16_t* cells;  // a cell in plane 0
  size_t plane, stride;
};

// Pixels that reach a block of 2 x 2 cells.
struct BlockReach {
  int16_t radius,
      edge;  // largest kRadiusPlane and kEdgePlane of the block's cells and of those that reach it
  // For each layer, the distance beyond the sides kReachLeft, .. kReachBottom of the pixels that
  // reach the block or the layer's margin around it.
  int16_t border[3][4];
};

// Summary of the surroundings of each cell of a row.
struct CellRanges {
  int16_t *low, *high;  // lowest and highest disparity
  uint16_t* widest;     // largest range of disparities of one of the cells
  int16_t* edge;        // largest blur radius at depth edges
};

namespace reference {

// Finds the pixels that reach the block whose first cell is at planes.cells. Cells up to `around`
// cells away are considered. margins[layer] is the margin of a layer in pixels, ascending from 0.
// Pixels that only reach a margin count as whole cells.
void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                BlockReach* reach);

// Finds the surroundings that each of `count` cells of a row, from planes.cells on, may show or be
// hidden by.
//
// A cell that is d <= around cells away (the larger of columns and rows) counts if the kReachPlane
// of the middle cell exceeds (d - 1) kCellPixels. If its kHighPlane exceeds that of the middle
// cell, it also counts if its own kNearPlane exceeds that value. Farther surfaces stay hidden,
// whatever their reach. kNearPlane is at most kReachPlane. Whole groups of kSliceLanes are read and
// written.
void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                   const CellRanges& ranges);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_NEIGHBOURHOOD_H_
