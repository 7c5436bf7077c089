// SPDX-License-Identifier: Apache-2.0
// Measures the range of the disparities of each cell of a map, so that areas without a step of
// disparity are found without reading their pixels again.
#ifndef STARFOCUS_LIB_DEPTH_CELL_RANGES_H_
#define STARFOCUS_LIB_DEPTH_CELL_RANGES_H_

#include <cstdint>

#include "lib/base/arena.h"
#include "lib/depth/thin_cells.h"

namespace starfocus {

// Smallest and largest disparity of each cell of a map, row by row.
struct CellRanges {
  int16_t *low, *high;
};
CellRanges TakeCellRanges(const ThinGrid& grid, Arena* arena);

// Fills the ranges of the cells of tile `index` of a map.
void MeasureCells(const ThinGrid& grid, const int16_t* map, int32_t index,
                  const CellRanges& ranges);

// Returns true if two disparities in cell `number` and the eight cells around it differ by more
// than `step`.
bool MayHaveStep(const ThinGrid& grid, const CellRanges& ranges, int32_t number, int32_t step);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_CELL_RANGES_H_
