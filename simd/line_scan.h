// SPDX-License-Identifier: Apache-2.0
// SIMD kernels of the line scan. FindRuns splits lines of disparities into runs of pixels that move
// together, and Blend moves spans of such pixels by a fraction of a pixel. The kernels have a table
// of their own, so that a program without the line scan does not link them.
#ifndef STARFOCUS_SIMD_LINE_SCAN_H_
#define STARFOCUS_SIMD_LINE_SCAN_H_

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "simd/gather.h"
#include "simd/samples.h"

namespace starfocus::simd {

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

// Fractional bits of the weights of Blend.
inline constexpr int kBlendBits = 14;

namespace reference {

inline void FindRunsOfLine(const int16_t* disparity, ptrdiff_t step, size_t length, int16_t spread,
                           int16_t edge_limit, const RunMarks& marks) {
  int low = disparity[0], high = low, before = low;
  for (size_t q = 0; q < length; ++q, disparity += step) {
    const int here = *disparity;
    low = here < low ? here : low;
    high = here > high ? here : high;
    const bool start = high - low > spread;
    if (start) low = high = here;
    const bool edge = std::abs(here - before) > edge_limit;
    before = here;
    const size_t word = q / 16 * marks.stride;
    if (q % 16 == 0) marks.starts[word] = marks.edges[word] = 0;
    marks.starts[word] = static_cast<uint16_t>(marks.starts[word] | (start ? 1 << q % 16 : 0));
    marks.edges[word] = static_cast<uint16_t>(marks.edges[word] | (edge ? 1 << q % 16 : 0));
    marks.middles[q * marks.stride] = static_cast<int16_t>((low + high) >> 1);
  }
}

// Splits lines 0 .. lines - 1 of `length` positions into runs, greedily from position 0 on.
// Position q of line k is disparity[q * step + k]. The bits of position 0, and of positions past
// the last one, are 0. The middle at position q is the mean, rounded down, of the lowest and the
// highest disparity of the run up to position q.
//
// `spread` is the largest difference between disparities in a run, in [0, edge]. `edge` is the
// largest step that is not a depth edge, < 32767. All disparities must have the same scale; any
// scale is permitted.
//
// Marks are written in whole groups of kRunLanes lines; marks of lines at or beyond `lines` are
// unspecified.
STARFOCUS_REFERENCE void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length,
                                  size_t lines, int16_t spread, int16_t edge,
                                  const RunMarks& marks) {
  for (size_t k = 0; k < lines; ++k) {
    FindRunsOfLine(disparity + k, step, length, spread, edge,
                   {marks.starts + k, marks.edges + k, marks.middles + k, marks.stride});
  }
}

inline int16_t BlendValue(const Span& span, uint32_t n) {
  const int32_t value = SourceOf(span, n);
  if (span.neighbour_weight == 0) return static_cast<int16_t>(value);
  const int32_t weight = span.neighbour_weight << (15 - kBlendBits);
  return static_cast<int16_t>(value + Product15(NeighbourOf(span, n) - value, weight));
}

// Stores value n of each span in line[target + n]. The two weights of a span sum to 2^kBlendBits,
// and the neighbour's weight is at most half of this sum. The weighted difference between neighbour
// and sample is rounded half up. Sources must not overlap the line. Samples of the line outside the
// spans are not written.
STARFOCUS_REFERENCE void Blend(const Span* spans, size_t count, int16_t* line) {
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t n = 0; n < spans[i].samples; ++n) {
      line[spans[i].target + n] = BlendValue(spans[i], n);
    }
  }
}

}  // namespace reference

}  // namespace starfocus::simd

#endif  // STARFOCUS_SIMD_LINE_SCAN_H_
