// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "simd/runs.h"

namespace starfocus::simd::reference {
namespace {

void FindRunsOfLine(const int16_t* disparity, ptrdiff_t step, size_t length,
                    const RunLimits& limits, const RunMarks& marks) {
  int low = disparity[0], high = low, before = low;
  for (size_t q = 0; q < length; ++q, disparity += step) {
    const int here = *disparity;
    low = here < low ? here : low;
    high = here > high ? here : high;
    const bool start = high - low > limits.spread;
    if (start) low = high = here;
    const bool edge = std::abs(here - before) > limits.edge;
    before = here;
    const size_t word = q / 16 * marks.stride;
    if (q % 16 == 0) marks.starts[word] = marks.edges[word] = 0;
    marks.starts[word] = static_cast<uint16_t>(marks.starts[word] | (start ? 1 << q % 16 : 0));
    marks.edges[word] = static_cast<uint16_t>(marks.edges[word] | (edge ? 1 << q % 16 : 0));
    marks.middles[q * marks.stride] = static_cast<int16_t>((low + high) >> 1);
  }
}

}  // namespace

void FindRuns(const int16_t* disparity, ptrdiff_t step, size_t length, size_t lines,
              const RunLimits& limits, const RunMarks& marks) {
  for (size_t k = 0; k < lines; ++k) {
    FindRunsOfLine(disparity + k, step, length, limits,
                   {marks.starts + k, marks.edges + k, marks.middles + k, marks.stride});
  }
}

}  // namespace starfocus::simd::reference
