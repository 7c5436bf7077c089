// SPDX-License-Identifier: Apache-2.0
#include "lib/line_scan/runs.h"

#include "lib/base/fixed.h"

namespace starfocus {
void MarkRuns(const simd::Kernels& kernels, const ViewGrid& grid, const LineBundle& bundle,
              Direction direction, simd::RunMarks* marks) {
  marks->stride = RunMarkStride(static_cast<size_t>(bundle.lines));
  const bool mirrored = direction == Direction::kLeftToRight;
  const simd::RunLimits limits = {static_cast<int16_t>(grid.spread), kSurfaceStep};
  kernels.FindRuns(bundle.disparity + (mirrored ? 0 : (bundle.length - 1) * bundle.step),
                   mirrored ? bundle.step : -bundle.step, static_cast<size_t>(bundle.length),
                   static_cast<size_t>(bundle.lines), limits, *marks);
}

int32_t ReadRuns(const simd::RunMarks& marks, int32_t k, int32_t length, const ViewGrid& grid,
                 int64_t subaperture_move, Run* runs) {
  Run* run = runs;
  int32_t surface_end = length;
  // The middle disparity of a run is stored at the last position of the run in scan order.
  const int16_t* const middles = marks.middles + static_cast<ptrdiff_t>(k);
  const auto add = [&](int32_t begin) {
    const int16_t disparity = middles[static_cast<size_t>(length - 1 - begin) * marks.stride];
    run->begin = static_cast<uint16_t>(begin);
    run->surface_end = static_cast<uint16_t>(surface_end);
    run->disparity = disparity;
    run->subaperture = static_cast<uint16_t>(Abs(grid.Shift(subaperture_move, disparity)));
    ++run;
  };
  size_t word = static_cast<size_t>(k);
  for (int32_t begin = length; begin > 0; begin -= 16, word += marks.stride) {
    // Each depth edge starts a run, because disparities within a run differ by less than the step
    // of an edge.
    for (uint32_t starts = marks.starts[word]; starts != 0; starts &= starts - 1) {
      const int32_t bit = LowestBit(starts);
      add(begin - bit);
      if ((marks.edges[word] >> bit & 1) != 0) surface_end = begin - bit;
    }
  }
  add(0);
  return static_cast<int32_t>(run - runs);
}

}  // namespace starfocus
