// SPDX-License-Identifier: Apache-2.0
// SIMD kernel that measures a cell, an 8x8 square of disparities, for the partition into blocks.
#ifndef STARFOCUS_SIMD_CELLS_H_
#define STARFOCUS_SIMD_CELLS_H_

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

// Measures the cell at rows[1] .. rows[8], columns 0 .. 7. The surrounding pixels are read as well:
// rows[0] is the row above, rows[9] is the row below, and rows have columns -1 .. 8.
STARFOCUS_REFERENCE void MeasureCell(const int16_t* const rows[10], const CellLimits& limits,
                                     CellMeasure* measure) {
  for (int k = 0; k < 8; ++k) {
    measure->column_low[k] = measure->column_high[k] = rows[1][k];
    measure->row_low[k] = measure->row_high[k] = rows[1 + k][0];
  }
  measure->nearest = UINT16_MAX;
  measure->edge_low = INT16_MAX;
  measure->edge_high = INT16_MIN;
  for (int along = 0; along < 2; ++along) {
    measure->slopes[along] = measure->edges[along] = measure->gaps[along] = 0;
  }
  for (int y = 0; y < 8; ++y) {
    const int16_t* row = rows[1 + y];
    for (int x = 0; x < 8; ++x) {
      AddDisparity(row[x], &measure->column_low[x], &measure->column_high[x]);
      AddDisparity(row[x], &measure->row_low[y], &measure->row_high[y]);
      const int distance = std::abs(row[x] - limits.focus);
      if (distance < measure->nearest) measure->nearest = static_cast<uint16_t>(distance);
      AddStep(row[x - 1], row[x], x > 0, 0, limits, measure);
      AddStep(rows[y][x], row[x], y > 0, 1, limits, measure);
    }
    AddStep(row[7], row[8], false, 0, limits, measure);
  }
  for (int x = 0; x < 8; ++x) AddStep(rows[8][x], rows[9][x], false, 1, limits, measure);
}

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_CELLS_H_
