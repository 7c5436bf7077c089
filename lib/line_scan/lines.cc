// SPDX-License-Identifier: Apache-2.0
// Finds the runs of a line, and the colours of holes in captured views.
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/line_scan/line_scan.h"
#include "lib/line_scan/span_sink.h"

namespace starfocus {

int16_t RunRange(const ViewGrid& grid) {
  constexpr int64_t kSpread = int64_t{kRunDrift} << (kStepBits + kDisparityBits - kShiftBits);
  // The step is 0 if no view moves a pixel, so that any range is right.
  const int64_t range = grid.step == 0 ? kSurfaceStep : kSpread / grid.step;
  return static_cast<int16_t>(range < kSurfaceStep ? range : kSurfaceStep);
}

int32_t HalfViews(const ViewGrid& grid, int32_t views) {
  int32_t half = 0;
  if (views != 17) return half;
  while (half < grid.n() && 2 * (half + 1) * grid.radius <= grid.n()) ++half;
  return half;
}

void MarkRuns(const simd::LineScanKernels& kernels, int16_t range, const int16_t* disparity,
              ptrdiff_t step, int32_t length, int32_t lines, Direction direction,
              simd::RunMarks* marks) {
  marks->stride = RunMarkStride(static_cast<size_t>(lines));
  const bool mirrored = direction == Direction::kLeftToRight;
  kernels.FindRuns(disparity + (mirrored ? 0 : (length - 1) * step), mirrored ? step : -step,
                   static_cast<size_t>(length), static_cast<size_t>(lines), range, kSurfaceStep,
                   *marks);
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

namespace {

// Returns the displacement of a surface with the given disparity in the captured view, in pixels of
// the layer, kShiftBits.
int64_t CapturedShift(const ViewGrid& grid, int32_t disparity, bool half) {
  const int64_t full = int64_t{disparity} * (1 << (kShiftBits - kDisparityBits));
  return RoundShift(full * 2, 1 + grid.layer + (half ? 1 : 0));
}

// Returns the square of the sum of the absolute differences of R, G and B, at most (3
// kLightWhite)^2.
int64_t Difference(const int16_t* a, const int16_t* b) {
  const int64_t sum = Abs(a[0] - b[0]) + Abs(a[1] - b[1]) + Abs(a[2] - b[2]);
  return sum * sum;
}

// Replaces a pixel of a missing diagonal view by a mixture of both neighbouring views. The
// neighbour whose colour is closer to the background gets the larger weight. The weights favour one
// neighbour strongly, but change continuously with the colours. Transposing the picture transposes
// the result.
void MixNeighbours(const int16_t* a, const int16_t* b, const int16_t* colour, int16_t* out) {
  // kLeast is added to both weights, so that two neighbours that look like the background are mixed
  // equally.
  constexpr int64_t kLeast = 1 << (2 * kLightBits);
  const int64_t weight_a = Difference(b, colour) + kLeast;
  const int64_t weight_b = Difference(a, colour) + kLeast, sum = weight_a + weight_b;
  for (int c = 0; c < 3; ++c) {
    out[c] = static_cast<int16_t>((a[c] * weight_a + b[c] * weight_b + sum / 2) / sum);
  }
}

}  // namespace

void HoleFiller::Fill(int32_t begin, int32_t end, int32_t disparity, const int16_t* colour,
                      int16_t* out) const {
  if (input.views == 1) {
    for (int32_t p = begin; p < end; ++p, out += 3) std::memcpy(out, colour, 3 * sizeof(*out));
    return;
  }
  const bool half = Max(i, j) <= half_views;
  // Displacements of the surface relative to its position in the rendered view, kShiftBits: in the
  // centre view along each axis, and from there to the captured view.
  const int32_t along = u == 0 ? 0 : grid.Shift(moves[i], disparity);
  const int32_t across = v == 0 ? 0 : grid.Shift(moves[j], disparity);
  const auto captured = static_cast<int32_t>(CapturedShift(grid, disparity, half));
  // Reads `count` pixels of the line from pixel p on, in the captured view at (from_u, from_v).
  const auto read = [&](int from_u, int from_v, int32_t p, int32_t count, int16_t* rgb) {
    const int32_t left = (x + dx * p) * kShiftOne + u * along - from_u * captured;
    const int32_t top = (y + dy * p) * kShiftOne + v * across - from_v * captured;
    if (transposed) {
      ReadCaptured(input, layer, CapturedView(from_v, from_u, half), {top, left, dy, dx}, count,
                   rgb);
    } else {
      ReadCaptured(input, layer, CapturedView(from_u, from_v, half), {left, top, dx, dy}, count,
                   rgb);
    }
  };
  if (u == 0 || v == 0 || input.views != 5) {
    read(u, v, begin, end - begin, out);
    return;
  }
  constexpr int32_t kAtOnce = 16;
  int16_t horizontal[3 * kAtOnce];
  for (int32_t p = begin; p < end; p += kAtOnce) {
    const int32_t count = Min(kAtOnce, end - p);
    read(u, 0, p, count, horizontal);
    read(0, v, p, count, out);
    for (int32_t k = 0; k < count; ++k, out += 3) {
      MixNeighbours(horizontal + 3 * k, out, colour, out);
    }
  }
}

}  // namespace starfocus
