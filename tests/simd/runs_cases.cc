// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernel in simd/runs.h.
#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {
namespace {

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
  const size_t length = draw->Length(1, 70, 64), count = draw->Size(1, 40, 48);
  const size_t stride = count + draw->Size(0, 9, 0);
  const bool backwards = draw->Int(0, 1) == 1;
  const int16_t* disparity =
      call->Input("disparity", LineDisparities((length - 1) * stride + count, draw), kPadding);
  call->IgnoreRows(disparity + count, length - 1, stride, stride - count);
  const int16_t* first = disparity + (backwards ? (length - 1) * stride : 0);
  const ptrdiff_t step = backwards ? -ptrdiff_t(stride) : ptrdiff_t(stride);
  const int kind = draw->Int(0, 3);
  const int edge = kind == 0 ? 32766 : kind == 1 ? draw->Int(0, 32766) : draw->Int(0, 96);
  const int spread = draw->Int(0, 2) == 0 ? edge : draw->Int(0, edge);

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
    kernels.FindRuns(first, step, length, count, int16_t(spread), int16_t(edge), marks);
  });
}

}  // namespace test::kernel_cases
