// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/line_scan.h, and of Accumulate in simd/gather.h.
#include "tests/kernels/kernel_cases.h"

namespace test {
namespace line_scan_cases {
namespace {

struct Spans {
  const Span* spans;
  size_t count, end;
};

// Makes consecutive spans, whose targets have gaps of up to two samples, and the source samples of
// these spans. If `blend` is true, both weights of a span sum to 2^kBlendBits, and the neighbour's
// weight is at most half of this sum.
Spans MakeSpans(bool blend, Draw* draw, CallMemory* call) {
  constexpr size_t kMargin = 8;  // samples for neighbours and unaligned starts
  const size_t samples = draw->Length(1, kLongestBytes, 96);
  const size_t count = draw->Size(1, 5, kTimedSamples / 96);
  const std::vector<int16_t> light = Light(kMargin + samples + kMargin, draw);
  const int16_t* source = call->Input("source", light, kPadding) + kMargin;
  std::vector<Span> spans;
  uint32_t target = uint32_t(draw->Int(0, 5));
  for (size_t i = 0; i < count; ++i) {
    const int kind = draw->timed() ? 2 : draw->Int(0, 3);
    const int one = blend ? 1 << kBlendBits : draw->Int(0, 1) == 0 ? 32767 : draw->Int(0, 32767);
    const int most = blend ? one / 2 : one;
    const int neighbour = kind == 0 ? 0 : kind == 1 ? most : draw->Int(0, most);
    Span span;
    span.source = source + draw->Int(-3, 3);
    span.target = target;
    span.samples = uint32_t(samples);
    span.neighbour_weight = uint16_t(neighbour);
    span.weight = uint16_t(blend ? one - neighbour : kind == 1 ? 32767 : one);
    span.neighbour_offset = draw->Int(0, 1) == 0 ? 3 : -3;
    spans.push_back(span);
    target += uint32_t(samples) + uint32_t(draw->Int(0, 2));
  }
  return {call->Input("spans", spans), count, target};
}

template <class T>
T* MakeTarget(const char* name, const Spans& spans, CallMemory* call) {
  T* target = call->Output<T>(name, spans.end);
  for (size_t i = 0; i < spans.count; ++i) {
    call->Result(target + spans.spans[i].target, spans.spans[i].samples);
  }
  return target;
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

void Blend(Draw* draw, LineScanCall* call) {
  const Spans spans = MakeSpans(true, draw, call);
  auto* line = MakeTarget<int16_t>("line", spans, call);
  call->Runs(
      [=](const LineScanKernels& kernels) { kernels.Blend(spans.spans, spans.count, line); });
}

void FindRuns(Draw* draw, LineScanCall* call) {
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
  call->Runs([=](const LineScanKernels& kernels) {
    kernels.FindRuns(first, step, length, count, int16_t(spread), int16_t(edge), marks);
  });
}

}  // namespace line_scan_cases

namespace kernel_cases {

void Accumulate(Draw* draw, KernelCall* call) {
  const line_scan_cases::Spans spans = line_scan_cases::MakeSpans(false, draw, call);
  auto* accumulators = line_scan_cases::MakeTarget<uint32_t>("accumulators", spans, call);
  for (size_t n = 0; n < spans.end; ++n) accumulators[n] = draw->Next() >> 4;
  call->Runs(
      [=](const Kernels& kernels) { kernels.Accumulate(spans.spans, spans.count, accumulators); });
}

}  // namespace kernel_cases
}  // namespace test
