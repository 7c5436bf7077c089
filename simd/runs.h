// SPDX-License-Identifier: Apache-2.0
// The kernel of the line scan: it splits lines of disparities into runs that move as one.
#ifndef STARFOCUS_SIMD_RUNS_H_
#define STARFOCUS_SIMD_RUNS_H_

#include <cstddef>
#include <cstdint>

namespace starfocus::simd {

// When a run of a line ends. Disparities may have any scale.
struct RunLimits {
  int16_t spread;  // the disparities of a run differ by this at most, [0, edge]
  int16_t edge;    // a step by more than this is a depth edge, < 32767
};

inline constexpr size_t kRunLanes = 16;

// What FindRuns tells of lines that lie side by side. The marks of line k are column k of each
// array, whose rows lie `stride` apart; stride is a multiple of kRunLanes and at least the number
// of lines.
struct RunMarks {
  uint16_t*
      starts;       // bit q % 16 of starts[q / 16 * stride + k]: whether a run starts at position q
  uint16_t* edges;  // the same bit: whether a depth edge lies before position q
  int16_t* middles;  // middles[q * stride + k]: see FindRuns
  size_t stride;
};

namespace reference {

// Splits lines 0 .. lines - 1 of `length` positions, greedily from position 0 on; position q of
// line k is disparity[q * step + k]. Both bits are 0 at position 0 and past the last one. middles
// tell the middle, rounded down, of the lowest and the highest disparity of the run up to each
// position. Of the marks whole groups of kRunLanes lines are written; those of lines that are not
// there are unspecified.
void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
              const RunLimits& limits, const RunMarks& marks);

}  // namespace reference
}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_RUNS_H_
