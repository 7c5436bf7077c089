// SPDX-License-Identifier: Apache-2.0
// The case of the kernel of simd/runs.h.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {
namespace {

// Lines side by side, forwards (step > 0) or backwards: `first` is position 0 of line 0.
struct Lines {
  const int16_t* first;
  ptrdiff_t step;
  int length, count;

  int At(int q, int k) const { return first[q * step + k]; }
};

RunLimits DrawRunLimits(Draw* draw) {
  const int kind = draw->Int(0, 3);
  const int edge = kind == 0 ? 32766 : kind == 1 ? draw->Int(0, 32766) : draw->Int(0, 96);
  return {int16_t(draw->Int(0, 2) == 0 ? edge : draw->Int(0, edge)), int16_t(edge)};
}

bool Bit(const uint16_t* words, const RunMarks& marks, int q, int k) {
  return (words[size_t(q / 16) * marks.stride + size_t(k)] >> (q % 16) & 1) != 0;
}

// The definition once more for line k: greedily, position by position.
bool MarksAreRight(const RunMarks& marks, const Lines& lines, int k, const RunLimits& limits) {
  int begin = 0;
  for (int q = 0; q < lines.length; ++q) {
    int low = lines.At(q, k), high = low;
    for (int at = begin; at < q; ++at) {
      low = std::min(low, lines.At(at, k));
      high = std::max(high, lines.At(at, k));
    }
    const bool start = high - low > limits.spread;
    if (start) begin = q, low = high = lines.At(q, k);
    const double middle = std::floor((low + high) / 2.0);
    const bool edge = q > 0 && std::abs(lines.At(q, k) - lines.At(q - 1, k)) > limits.edge;
    if (Bit(marks.starts, marks, q, k) != start || Bit(marks.edges, marks, q, k) != edge)
      return false;
    if (marks.middles[size_t(q) * marks.stride + size_t(k)] != middle) return false;
  }
  for (int q = lines.length; q % 16 != 0; ++q) {  // bits of positions that are not there
    if (Bit(marks.starts, marks, q, k) || Bit(marks.edges, marks, q, k)) return false;
  }
  return true;
}

std::vector<int16_t> LineDisparities(size_t count, Draw* draw) {
  const int kind = draw->timed() ? 2 : draw->Int(0, 3);
  const int most = kind == 0 ? 32000 : kind == 1 ? 300 : 40;
  return Filled<int16_t>(count, [&] {
    const int d = draw->Int(-most, most);
    return kind != 3 ? d : d < 0 ? -32000 : 32000;
  });
}

}  // namespace

void FindRuns(Draw* draw, KernelCall* call) {
  Lines lines;
  lines.length = int(draw->Length(1, 70, 64));
  lines.count = int(draw->Size(1, 40, 48));
  const size_t count = size_t(lines.count), length = size_t(lines.length);
  const size_t stride = count + draw->Size(0, 9, 0);
  const bool backwards = draw->Int(0, 1) == 1;
  const int16_t* disparity =
      call->Input("disparity", LineDisparities((length - 1) * stride + count, draw), kPadding);
  call->IgnoreRows(disparity + count, length - 1, stride, stride - count);
  lines.first = disparity + (backwards ? (length - 1) * stride : 0);
  lines.step = backwards ? -ptrdiff_t(stride) : ptrdiff_t(stride);
  const RunLimits limits = DrawRunLimits(draw);

  const size_t whole = (count + kRunLanes - 1) / kRunLanes * kRunLanes, rows = (length + 15) / 16;
  RunMarks marks;
  marks.stride = whole + kRunLanes * draw->Size(0, 1, 0);
  marks.starts = call->Output<uint16_t>("starts", rows * marks.stride);
  marks.edges = call->Output<uint16_t>("edges", rows * marks.stride);
  marks.middles = call->Output<int16_t>("middles", length * marks.stride);
  call->ResultRows(marks.middles, length, marks.stride, count, whole - count);
  for (const uint16_t* words : {marks.starts, marks.edges}) {
    call->ResultRows(words, rows, marks.stride, count, whole - count);
  }
  call->Runs([=](const Kernels& kernels) {
    kernels.FindRuns(lines.first, lines.step, length, count, limits, marks);
  });
  call->is_right = [=](uint64_t, Met*) {
    return AllRight(count, [&](size_t k) { return MarksAreRight(marks, lines, int(k), limits); });
  };
}

}  // namespace test::kernel_cases
