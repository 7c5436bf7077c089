// SPDX-License-Identifier: Apache-2.0
// Runs of equal disparity along a line. Runs are found once per line and shared by all views of the
// line.
#ifndef STARFOCUS_LIB_LINE_SCAN_RUNS_H_
#define STARFOCUS_LIB_LINE_SCAN_RUNS_H_

#include <cstddef>
#include <cstdint>

#include "lib/optics/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

// Positions [begin, end) of a line. `end` equals `begin` of the previous run in scan order.
struct Run {
  uint16_t begin;
  // End of the surface that the run belongs to: the next depth edge or the end of the line.
  uint16_t surface_end;
  int16_t disparity;     // Middle of the range of the run's disparities, kDisparityBits.
  uint16_t subaperture;  // Width of the run's subaperture r / N, kShiftBits.
};

// Scan order of a line. Views to the right of the centre or below the centre are scanned from the
// right end, because nearer surfaces move in from that end. Views to the left of the centre or
// above the centre are mirrored.
enum class Direction { kRightToLeft, kLeftToRight };

// Adjacent lines: position q of line k is disparity[q * step + k].
struct LineBundle {
  const int16_t* disparity;
  ptrdiff_t step;
  int32_t length;  // [1, 65535]
  int32_t lines;
};

// Sizes of the arrays of RunMarks: `starts` and `edges` have RunMarkWords elements, and `middles`
// has RunMiddles elements.
constexpr size_t RunMarkStride(size_t lines) {
  return (lines + simd::kRunLanes - 1) / simd::kRunLanes * simd::kRunLanes;
}
constexpr size_t RunMarkWords(size_t length, size_t lines) {
  return (length + 15) / 16 * RunMarkStride(lines);
}
constexpr size_t RunMiddles(size_t length, size_t lines) { return length * RunMarkStride(lines); }

// Splits lines into runs whose disparities vary by at most grid.spread, greedily in scan order.
// Sets marks->stride. The arrays of `marks` must have room for the bundle, and the disparities must
// be followed by simd::kPadding bytes.
void MarkRuns(const simd::Kernels& kernels, const ViewGrid& grid, const LineBundle& bundle,
              Direction direction, simd::RunMarks* marks);

// Reads the runs of line k in scan order, from high positions to low positions. With kLeftToRight,
// positions are mirrored: position q is pixel length - 1 - q. `subaperture_move` is
// ViewGrid::Move(1). Writes at most `length` runs and returns the number of runs.
int32_t ReadRuns(const simd::RunMarks& marks, int32_t k, int32_t length, const ViewGrid& grid,
                 int64_t subaperture_move, Run* runs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_RUNS_H_
