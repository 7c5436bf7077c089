// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "simd/cells.h"

namespace starfocus::simd::reference {
namespace {

void AddDisparity(int16_t disparity, int16_t* low, int16_t* high) {
  if (disparity < *low) *low = disparity;
  if (disparity > *high) *high = disparity;
}

// Adds the difference between disparities a and b, which are neighbours in a row (`along` = 0) or
// in a column (`along` = 1). `inside` is true if both neighbours belong to the cell.
void AddStep(int a, int b, bool inside, int along, const CellLimits& limits, CellMeasure* measure) {
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

}  // namespace

void MeasureCell(const int16_t* const rows[10], const CellLimits& limits, CellMeasure* measure) {
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

}  // namespace starfocus::simd::reference
