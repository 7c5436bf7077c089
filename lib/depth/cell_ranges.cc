// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/cell_ranges.h"

#include <algorithm>

namespace starfocus {

CellRanges TakeCellRanges(const ThinGrid& grid, Arena* arena) {
  const auto cells = static_cast<size_t>(grid.Cells());
  CellRanges ranges;
  ranges.low = arena->Take<int16_t>(cells);
  ranges.high = arena->Take<int16_t>(cells);
  return ranges;
}

void MeasureCells(const ThinGrid& grid, const int16_t* map, int32_t index,
                  const CellRanges& ranges) {
  ForCells(grid, index, [&](const Rect& cell, int32_t number) {
    int16_t low = INT16_MAX, high = INT16_MIN;
    for (int32_t y = cell.y; y < cell.y + cell.height; ++y) {
      const int16_t* row = map + static_cast<ptrdiff_t>(y) * grid.width + cell.x;
      for (int32_t x = 0; x < cell.width; ++x) {
        low = std::min(low, row[x]);
        high = std::max(high, row[x]);
      }
    }
    ranges.low[number] = low;
    ranges.high[number] = high;
  });
}

bool MayHaveStep(const ThinGrid& grid, const CellRanges& ranges, int32_t number, int32_t step) {
  int16_t low = INT16_MAX, high = INT16_MIN;
  ForAround(grid, number % grid.columns, number / grid.columns, 1,
            [&](int32_t, int32_t, int32_t other) {
              low = std::min(low, ranges.low[other]);
              high = std::max(high, ranges.high[other]);
            });
  return high - low > step;
}

}  // namespace starfocus
