// SPDX-License-Identifier: Apache-2.0
// SIMD kernels that examine the cells around a block or around each cell. The kernels find the
// cells whose blur reaches the block or cell, and the cells that the blur of the block or cell
// reaches.
#ifndef STARFOCUS_SIMD_NEIGHBOURHOOD_H_
#define STARFOCUS_SIMD_NEIGHBOURHOOD_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/samples.h"

namespace starfocus::simd {

inline constexpr int16_t kCellPixels = 8;

// Properties of a cell. Each property has one plane of values. All distances are in pixels.
enum CellPlane {
  kReachLeft,  // largest distance beyond each side to which the cell's pixels are splatted
  kReachRight,
  kReachTop,
  kReachBottom,
  // Largest distance from each side to pixels inside the cell that reach beyond this side, [0,
  // kCellPixels].
  kInsideLeft,
  kInsideRight,
  kInsideTop,
  kInsideBottom,
  kReachPlane,   // Largest reach of the cell's blur to any side.
  kNearPlane,    // Reach of the blur of the cell's nearest pixels.
  kRadiusPlane,  // Largest blur radius.
  kEdgePlane,    // Largest blur radius at depth edges; 0 if the cell has no depth edges.
  kLowPlane,     // Lowest and highest disparity of the cell.
  kHighPlane,
  kCellPlanes
};

// Planes of the cells of a picture. Planes are `plane` samples apart, and rows `stride` samples
// apart.
struct CellPlanes {
  const int16_t* cells;  // pointer to a cell in plane 0
  size_t plane, stride;
};

// Describes the pixels that reach a block of 2 x 2 cells.
struct BlockReach {
  // Largest kRadiusPlane and largest kEdgePlane of the block's cells and of all cells that reach
  // the block.
  int16_t radius, edge;
  // border[layer][side] is the largest distance beyond a side of the block of pixels that reach the
  // block or the layer's margin around the block. Sides are kReachLeft .. kReachBottom.
  int16_t border[3][4];
};

// Properties of the surroundings of each cell of a row.
struct CellRanges {
  int16_t *low, *high;  // Lowest and highest disparity of the surroundings.
  uint16_t* widest;     // Largest range of disparities within any single surrounding cell.
  int16_t* edge;        // Largest blur radius at depth edges in the surroundings.
};

namespace reference {

// Returns the number of pixels between cell k and a block that consists of cells `around` and
// `around` + 1. The result is negative if cell k is in the block.
inline int GapTo(int k, int around) {
  const int before = around - 1 - k, behind = k - around - 2;
  return kCellPixels * (before > behind ? before : behind);
}

inline void AddReach(int value, int16_t* largest) {
  if (value > *largest) *largest = static_cast<int16_t>(value);
}

// Finds the pixels that reach the block whose first cell is planes.cells. Cells up to `around`
// cells away are examined. The margin of a layer in pixels is margins[layer]; margins[0] is 0, and
// margins increase with the layer. For layers 1 and 2, `border` includes all pixels of every cell
// whose blur reaches the margin of the layer.
STARFOCUS_REFERENCE void ReachBlock(const CellPlanes& planes, int32_t around,
                                    const int16_t margins[3], BlockReach* reach) {
  *reach = {};
  const int side = 2 * around + 2;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int16_t* cell =
          planes.cells + (y - around) * static_cast<ptrdiff_t>(planes.stride) + x - around;
      const auto value = [&](int plane) -> int {
        return cell[static_cast<size_t>(plane) * planes.plane];
      };
      const int gap_x = GapTo(x, around), gap_y = GapTo(y, around);
      // Cells reach the block across their side that faces the block: a cell to the left of the
      // block across its right side.
      const int from_x = x < around ? kReachRight : kReachLeft;
      const int from_y = y < around ? kReachBottom : kReachTop;
      for (int layer = 0; layer < 3; ++layer) {
        if (gap_x >= 0 && value(from_x) + margins[layer] <= gap_x) continue;
        if (gap_y >= 0 && value(from_y) + margins[layer] <= gap_y) continue;
        if (layer == 0) {
          AddReach(value(kRadiusPlane), &reach->radius);
          AddReach(value(kEdgePlane), &reach->edge);
        }
        const auto inside = [&](int from) -> int {
          return layer == 0 ? value(from + kInsideLeft - kReachLeft) : kCellPixels;
        };
        int16_t(&border)[4] = reach->border[layer];
        if (gap_x >= 0) {
          AddReach(gap_x + inside(from_x), &border[x < around ? kReachLeft : kReachRight]);
        }
        if (gap_y >= 0) {
          AddReach(gap_y + inside(from_y), &border[y < around ? kReachTop : kReachBottom]);
        }
      }
    }
  }
}

// Examines the surroundings of each of `count` cells of a row; planes.cells is the first cell. The
// surroundings of a middle cell are the cells that the middle cell's blur may reach, and the cells
// that may hide the middle cell.
//
// Let d <= around be the distance of a cell from the middle cell, which is the larger of the
// distances in columns and rows. The cell belongs to the surroundings if the kReachPlane of the
// middle cell exceeds (d - 1) kCellPixels. A cell with a larger kHighPlane than the middle cell
// belongs to the surroundings as well if its own kNearPlane exceeds (d - 1) kCellPixels. Farther
// surfaces stay hidden, regardless of their reach. Values of kNearPlane are at most the values of
// kReachPlane. Whole groups of kSliceLanes are read and written.
STARFOCUS_REFERENCE void SurroundCells(const CellPlanes& planes, int32_t around, size_t count,
                                       const CellRanges& ranges) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int16_t* cell = planes.cells + n;
    int16_t low = INT16_MAX, high = INT16_MIN, edge = 0;
    int widest = 0;
    for (int y = -around; y <= around; ++y) {
      for (int x = -around; x <= around; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(planes.stride) + x;
        const int away = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
        const int16_t first = at[kLowPlane * planes.plane], last = at[kHighPlane * planes.plane];
        const bool nearer = last > cell[kHighPlane * planes.plane];
        const int own = cell[kReachPlane * planes.plane];
        const int other = nearer ? at[kNearPlane * planes.plane] : 0;
        if ((away - 1) * kCellPixels >= (own > other ? own : other)) continue;
        low = first < low ? first : low;
        high = last > high ? last : high;
        widest = last - first > widest ? last - first : widest;
        AddReach(at[kEdgePlane * planes.plane], &edge);
      }
    }
    ranges.low[n] = low;
    ranges.high[n] = high;
    ranges.widest[n] = static_cast<uint16_t>(widest);
    ranges.edge[n] = edge;
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_NEIGHBOURHOOD_H_
