// SPDX-License-Identifier: Apache-2.0
// SIMD kernel of the line scan. The kernel splits lines of disparities into runs of pixels that
// move together.
#ifndef STARFOCUS_SIMD_RUNS_H_
#define STARFOCUS_SIMD_RUNS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// Limits of the disparities in a run. All disparities must have the same scale; any scale is
// permitted.
struct RunLimits {
  int16_t spread;  // Largest difference between disparities in a run, [0, edge].
  int16_t edge;    // Largest step that is not a depth edge, < 32767.
};

inline constexpr size_t kRunLanes = 16;

// Output of FindRuns for adjacent lines. The marks of line k are in column k of each array. Rows of
// the arrays are `stride` elements apart. `stride` is a multiple of kRunLanes and at least the
// number of lines.
struct RunMarks {
  uint16_t* starts;  // Bit q % 16 of starts[q / 16 * stride + k] is set if a run starts at q.
  // In the format of `starts`: a bit is set if a depth edge lies before position q.
  uint16_t* edges;
  int16_t* middles;  // middles[q * stride + k]: middle of the run up to position q (FindRuns)
  size_t stride;
};

namespace reference {

// Splits lines 0 .. lines - 1 of `length` positions into runs, greedily from position 0 on.
// Position q of line k is disparity[q * step + k]. The bits of position 0, and of positions past
// the last one, are 0. The middle at position q is the mean, rounded down, of the lowest and the
// highest disparity of the run up to position q. Marks are written in whole groups of kRunLanes
// lines; marks of lines at or beyond `lines` are unspecified.
void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
              const RunLimits& limits, const RunMarks& marks);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_RUNS_H_
