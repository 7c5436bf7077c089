// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that measures a cell, an 8x8 square of disparities, for the partition into blocks.
#ifndef STARFOCUS_SIMD_CELLS_H_
#define STARFOCUS_SIMD_CELLS_H_

#include <cstdint>

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
  int16_t column_low[8], column_high[8];  // Lowest and highest disparity of each column.
  int16_t row_low[8], row_high[8];        // Lowest and highest disparity of each row.
  uint16_t nearest;                       // Smallest |disparity - focus|.
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

namespace reference {

// Measures the cell at rows[1] .. rows[8], columns 0 .. 7. The surrounding pixels are read as well:
// rows[0] is the row above, rows[9] is the row below, and rows have columns -1 .. 8.
void MeasureCell(const int16_t* const rows[10], const CellLimits& limits, CellMeasure* measure);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_CELLS_H_
