// SPDX-License-Identifier: Apache-2.0
// Kernels that look at the cells around a block or a cell: what of them its blur reaches, and what
// of theirs reaches it.
#ifndef STARFOCUS_SIMD_NEIGHBOURHOOD_H_
#define STARFOCUS_SIMD_NEIGHBOURHOOD_H_

#include <cstddef>
#include <cstdint>

#include "simd/padding.h"

namespace starfocus::simd {

inline constexpr int16_t kCellPixels = 8;

// What is known of each cell, a plane each. Reaches and insides are pixels.
enum CellPlane {
  kReachLeft,  // how far beyond each side the cell's pixels are splatted
  kReachRight,
  kReachTop,
  kReachBottom,
  kInsideLeft,  // how deep inside that side the pixels lie that reach beyond it, [0, kCellPixels]
  kInsideRight,
  kInsideTop,
  kInsideBottom,
  kReachPlane,   // how far the cell's blur reaches at most, to any side
  kNearPlane,    // how far that of its nearest pixels does
  kRadiusPlane,  // the largest blur radius
  kEdgePlane,    // the largest blur radius at depth edges, 0 where there is none
  kLowPlane,     // the lowest and the highest disparity
  kHighPlane,
  kCellPlanes
};

// Planes of a picture's cells, `plane` samples apart, with rows `stride` samples apart.
struct CellPlanes {
  const int16_t* cells;  // a cell in plane 0
  size_t plane, stride;
};

// What reaches a block of 2 x 2 cells.
struct BlockReach {
  int16_t radius,
      edge;  // the largest kRadiusPlane and kEdgePlane of its cells and what reaches them
  // For each layer, how far beyond the sides kReachLeft, .. kReachBottom pixels lie that are
  // splatted into the block or into the layer's margin around it.
  int16_t border[3][4];
};

// What lies around each cell of a row.
struct CellRanges {
  int16_t *low, *high;  // the lowest and the highest disparity
  uint16_t* widest;     // the largest range of disparities that one of the cells has
  int16_t* edge;        // the largest blur radius at depth edges
};

namespace reference {

// Finds what reaches the block whose first cell is at planes.cells, from `around` cells away at
// most. margins[layer] is a layer's margin in pixels, ascending from 0; pixels that reach only a
// margin count by whole cells.
void ReachBlock(const CellPlanes& planes, int32_t around, const int16_t margins[3],
                BlockReach* reach);

// Finds what each of `count` cells of a row, from planes.cells on, may show and what may hide it. A
// cell that lies d <= around cells away (in columns or rows, whichever are more) counts if the
// kReachPlane of the cell in the middle exceeds (d - 1) kCellPixels; and, if its kHighPlane exceeds
// that of the cell in the middle, if its own kNearPlane does. What lies farther stays hidden,
// however far it reaches. kNearPlane is at most kReachPlane. Whole groups of kSliceLanes are read
// and written.
void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                   const CellRanges& ranges);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_NEIGHBOURHOOD_H_
