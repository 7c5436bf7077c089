// SPDX-License-Identifier: Apache-2.0
// Runs of one disparity along a line: found once per line, shared by all its views.
#ifndef STARFOCUS_LIB_LINE_SCAN_RUNS_H_
#define STARFOCUS_LIB_LINE_SCAN_RUNS_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

// Positions [begin, end) of a line, end being the begin of the run before it in scan order.
struct Run {
  uint16_t begin;
  uint16_t surface_end;  // where the surface it belongs to ends: the next depth edge, or the line's
  int16_t disparity;     // kDisparityBits: the middle of the run's range
  uint16_t subaperture;  // width of its subaperture r / N, kShiftBits
};

// Scan order of a line. A view to the right of the centre (or below it) is scanned from the right
// end, where the surfaces that cover others come from; a view to the left is the mirror image.
enum class Direction { kRightToLeft, kLeftToRight };

// Lines side by side: position q of line k is disparity[q * step + k].
struct LineBundle {
  const int16_t* disparity;
  ptrdiff_t step;
  int32_t length;  // [1, 65535]
  int32_t lines;
};

// Elements of RunMarks::starts and edges, and of middles.
constexpr size_t RunMarkStride(size_t lines) {
  return (lines + simd::kRunLanes - 1) / simd::kRunLanes * simd::kRunLanes;
}
constexpr size_t RunMarkWords(size_t length, size_t lines) {
  return (length + 15) / 16 * RunMarkStride(lines);
}
constexpr size_t RunMiddles(size_t length, size_t lines) { return length * RunMarkStride(lines); }

// Splits lines into runs within which the disparity varies by at most grid.spread, greedily in scan
// order. marks->stride is set; its arrays have room for the bundle. The disparity is followed by
// simd::kPadding bytes.
void MarkRuns(const simd::Kernels& kernels, const ViewGrid& grid, const LineBundle& bundle,
              Direction direction, simd::RunMarks* marks);

// The runs of line k, in scan order, from high positions to low. Positions are mirrored for
// kLeftToRight: position q stands for pixel length - 1 - q. subaperture_move: ViewGrid::Move(1).
// Writes at most `length` runs, returns their number.
int32_t ReadRuns(const simd::RunMarks& marks, int32_t k, int32_t length, const ViewGrid& grid,
                 int64_t subaperture_move, Run* runs);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_RUNS_H_
