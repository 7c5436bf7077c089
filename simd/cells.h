// SPDX-License-Identifier: Apache-2.0
// SIMD kernels for cells, the 8x8 squares of disparities that blocks consist of. Two kernels
// measure a cell for the partition into blocks. The other kernels examine the cells around a block
// or around each cell. They find the cells whose blur reaches the block or cell, and the cells that
// the blur of the block or cell reaches.
#ifndef STARFOCUS_SIMD_CELLS_H_
#define STARFOCUS_SIMD_CELLS_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/samples.h"

namespace starfocus::simd {

struct CellLimits {
  int16_t focus;  // disparity from which CellMeasure::nearest is measured
  // Largest difference between neighbouring disparities that is not a depth edge; at most 4369, so
  // that the sum of 15 differences fits in 16 bits.
  int16_t edge;
  int16_t slope_limit;  // Limit to which the differences in CellMeasure::slopes are clamped.
  int16_t gap_limit;    // Limit to which the differences in CellMeasure::gaps are clamped.
};

// Output of MeasureCell for 8x8 disparities and their neighbours.
struct CellMeasure {
  int16_t low, high;  // Lowest and highest disparity.
  uint16_t nearest;   // Smallest |disparity - focus|.
  // Lowest and highest disparity of the nearer sides of depth edges. The edges lie between two
  // pixels of the cell, or between a pixel of the cell and a neighbour outside. If edge_low >
  // edge_high, the cell has no depth edge.
  int16_t edge_low, edge_high;
  // Statistics of the differences between neighbouring disparities inside the cell. Index 0 is for
  // neighbours in a row, and index 1 for neighbours in a column. `slopes` is the sum of the
  // differences within surfaces. `edges` is the number of depth edges, and `gaps` the sum of the
  // differences at depth edges.
  uint32_t slopes[2], edges[2], gaps[2];
};

// Output of MeasureLines for 8x8 disparities.
struct CellLines {
  int16_t column_low[8], column_high[8];  // Lowest and highest disparity of each column.
  int16_t row_low[8], row_high[8];        // Lowest and highest disparity of each row.
};

inline constexpr int16_t kCellPixels = 8;

// Properties of a cell. Each property has one plane of values. All distances are in pixels.
enum {
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

// Describes the pixels that reach a block of 2 x 2 cells.
struct BlockReach {
  // Largest kRadiusPlane and largest kEdgePlane of the block's cells and of all cells that reach
  // the block.
  int16_t radius, edge;
  // border[layer][side] is the largest distance beyond a side of the block of pixels that reach the
  // block or the layer's border around the block. Sides are kReachLeft .. kReachBottom.
  int16_t border[3][4];
};

namespace reference {

inline void AddDisparity(int16_t disparity, int16_t* low, int16_t* high) {
  if (disparity < *low) *low = disparity;
  if (disparity > *high) *high = disparity;
}

// Adds the difference between disparities a and b, which are neighbours in a row (`along` = 0) or
// in a column (`along` = 1). `inside` is true if both neighbours belong to the cell.
inline void AddStep(int a, int b, bool inside, int along, const CellLimits& limits,
                    CellMeasure* measure) {
  const int step = std::abs(a - b);
  const int nearer = a > b ? a : b;
  if (step > limits.edge) {
    if (nearer < measure->edge_low) measure->edge_low = static_cast<int16_t>(nearer);
    if (nearer > measure->edge_high) measure->edge_high = static_cast<int16_t>(nearer);
    if (!inside) return;
    ++measure->edges[along];
    measure->gaps[along] +=
        static_cast<uint32_t>(step < limits.gap_limit ? step : limits.gap_limit);
  } else if (inside) {
    const int counted = step < limits.slope_limit ? step : limits.slope_limit;
    measure->slopes[along] += static_cast<uint32_t>(counted);
  }
}

// Measures the cell at rows[1] .. rows[8] and at the 8 columns from `column` on. The surrounding
// pixels are read as well: rows[0] is the row above, rows[9] is the row below, and rows have
// columns column - 1 .. column + 8.
STARFOCUS_REFERENCE void MeasureCell(const int16_t* const rows[10], size_t column,
                                     const CellLimits& limits, CellMeasure* measure) {
  *measure = {};
  measure->low = measure->edge_low = INT16_MAX;
  measure->high = measure->edge_high = INT16_MIN;
  measure->nearest = UINT16_MAX;
  for (int y = 0; y < 8; ++y) {
    const int16_t *row = rows[1 + y] + column, *above = rows[y] + column;
    for (int x = 0; x < 8; ++x) {
      AddDisparity(row[x], &measure->low, &measure->high);
      const int distance = std::abs(row[x] - limits.focus);
      if (distance < measure->nearest) measure->nearest = static_cast<uint16_t>(distance);
      AddStep(row[x - 1], row[x], x > 0, 0, limits, measure);
      AddStep(above[x], row[x], y > 0, 1, limits, measure);
    }
    AddStep(row[7], row[8], false, 0, limits, measure);
  }
  for (size_t x = column; x < column + 8; ++x) {
    AddStep(rows[8][x], rows[9][x], false, 1, limits, measure);
  }
}

// Finds the ranges of the lines of a cell, which lies in `rows` like a cell of MeasureCell. Only
// the pixels of the cell are read.
STARFOCUS_REFERENCE void MeasureLines(const int16_t* const rows[10], size_t column,
                                      CellLines* lines) {
  for (int k = 0; k < 8; ++k) {
    lines->column_low[k] = lines->row_low[k] = INT16_MAX;
    lines->column_high[k] = lines->row_high[k] = INT16_MIN;
  }
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const int16_t disparity = rows[1 + y][column + static_cast<size_t>(x)];
      AddDisparity(disparity, &lines->column_low[x], &lines->column_high[x]);
      AddDisparity(disparity, &lines->row_low[y], &lines->row_high[y]);
    }
  }
}

// Returns the number of pixels between cell k and a block that consists of cells `around` and
// `around` + 1. The result is negative if cell k is in the block.
inline int GapTo(int k, int around) {
  const int before = around - 1 - k, behind = k - around - 2;
  return kCellPixels * (before > behind ? before : behind);
}

inline void AddReach(int value, int16_t* largest) {
  if (value > *largest) *largest = static_cast<int16_t>(value);
}

// Finds the pixels that reach a block; `cells` points to the block's first cell in plane 0. Planes
// are `plane` samples apart, and rows `stride` samples apart. Cells up to `around` cells away are
// examined. The border of a layer in pixels is borders[layer]; borders[0] is 0, and
// borders increase with the layer. For layers 1 and 2, `border` includes all pixels of every cell
// whose blur reaches the border of the layer.
STARFOCUS_REFERENCE void ReachBlock(const int16_t* cells, size_t plane, size_t stride,
                                    int32_t around, const int16_t borders[3], BlockReach* reach) {
  *reach = {};
  const int side = 2 * around + 2;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const int16_t* cell = cells + (y - around) * static_cast<ptrdiff_t>(stride) + x - around;
      const auto value = [&](int of) -> int { return cell[static_cast<size_t>(of) * plane]; };
      const int gap_x = GapTo(x, around), gap_y = GapTo(y, around);
      // Cells reach the block across their side that faces the block: a cell to the left of the
      // block across its right side.
      const int from_x = x < around ? kReachRight : kReachLeft;
      const int from_y = y < around ? kReachBottom : kReachTop;
      for (int layer = 0; layer < 3; ++layer) {
        if (gap_x >= 0 && value(from_x) + borders[layer] <= gap_x) continue;
        if (gap_y >= 0 && value(from_y) + borders[layer] <= gap_y) continue;
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

// Examines the surroundings of each of `count` cells of a row; `cells` points to the first cell, in
// planes like those of ReachBlock. The surroundings of a middle cell are the cells that the middle
// cell's blur may reach, and the cells that may hide the middle cell.
//
// Let d <= around be the distance of a cell from the middle cell, which is the larger of the
// distances in columns and rows. The cell belongs to the surroundings if the kReachPlane of the
// middle cell exceeds (d - 1) kCellPixels. A cell with a larger kHighPlane than the middle cell
// belongs to the surroundings as well if its own kNearPlane exceeds (d - 1) kCellPixels. Farther
// surfaces stay hidden, regardless of their reach. Values of kNearPlane are at most the values of
// kReachPlane. Whole groups of kSliceLanes are read and written.
//
// For cell n, the kernel writes the lowest and highest disparity of the surroundings, the largest
// range of disparities within any single surrounding cell, and the largest blur radius at depth
// edges in the surroundings.
STARFOCUS_REFERENCE void SurroundCells(const int16_t* cells, size_t plane, size_t stride,
                                       int32_t around, size_t count, int16_t* lows, int16_t* highs,
                                       uint16_t* ranges, int16_t* edges) {
  for (size_t n = 0; n < SliceSamples(count); ++n) {
    const int16_t* cell = cells + n;
    int16_t low = INT16_MAX, high = INT16_MIN, edge = 0;
    int widest = 0;
    for (int y = -around; y <= around; ++y) {
      for (int x = -around; x <= around; ++x) {
        const int16_t* at = cell + y * static_cast<ptrdiff_t>(stride) + x;
        const int away = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
        const int16_t first = at[kLowPlane * plane], last = at[kHighPlane * plane];
        const bool nearer = last > cell[kHighPlane * plane];
        const int own = cell[kReachPlane * plane];
        const int other = nearer ? at[kNearPlane * plane] : 0;
        if ((away - 1) * kCellPixels >= (own > other ? own : other)) continue;
        low = first < low ? first : low;
        high = last > high ? last : high;
        widest = last - first > widest ? last - first : widest;
        AddReach(at[kEdgePlane * plane], &edge);
      }
    }
    lows[n] = low;
    highs[n] = high;
    ranges[n] = static_cast<uint16_t>(widest);
    edges[n] = edge;
  }
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_CELLS_H_
