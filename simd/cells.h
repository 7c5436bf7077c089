// SPDX-License-Identifier: Apache-2.0
// The kernel that measures a cell, an 8x8 square of disparities, for the partition into blocks.
#ifndef STARFOCUS_SIMD_CELLS_H_
#define STARFOCUS_SIMD_CELLS_H_

#include <cstdint>

namespace starfocus::simd {

struct CellLimits {
  int16_t focus;        // the disparity that `nearest` is measured from
  int16_t edge;         // a step by more than this is a depth edge; <= 4369, so that 15 fit 16 bits
  int16_t slope_limit;  // a step within a surface counts for this at most
  int16_t gap_limit;    // a step at a depth edge counts for this at most
};

// What MeasureCell finds in 8x8 disparities and their neighbours.
struct CellMeasure {
  int16_t column_low[8], column_high[8];  // the lowest and the highest disparity of each column
  int16_t row_low[8], row_high[8];        // and of each row
  uint16_t nearest;                       // the smallest |disparity - focus|
  // The lowest and the highest disparity of the nearer sides of depth edges, between pixels of the
  // cell or between them and their neighbours outside. There is no edge where edge_low > edge_high.
  int16_t edge_low, edge_high;
  // These count steps from pixel to pixel inside the cell, along rows [0] and along columns [1]:
  // the sum of steps within a surface, the number of depth edges, and the sum of the steps there.
  uint32_t slopes[2], edges[2], gaps[2];
};

namespace reference {

// Measures the cell at rows[1] .. rows[8], columns 0 .. 7. The pixels around it are read as well:
// rows[0] is the row above, rows[9] the row below, and each row begins at column -1 and ends at 8.
void MeasureCell(const int16_t* const rows[10], const CellLimits& limits, CellMeasure* measure);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_CELLS_H_
