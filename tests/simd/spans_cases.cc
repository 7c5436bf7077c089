// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/spans.h.
#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {
namespace {

struct Spans {
  const Span* spans;
  size_t count, end;
};

// Makes consecutive spans, whose targets have gaps of up to two samples, and the source samples of
// these spans. If `blend` is true, both weights of a span sum to 2^kBlendBits, and the neighbour's
// weight is at most half of this sum.
Spans MakeSpans(bool blend, Draw* draw, KernelCall* call) {
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
T* MakeTarget(const char* name, const Spans& spans, KernelCall* call) {
  T* target = call->Output<T>(name, spans.end);
  for (size_t i = 0; i < spans.count; ++i) {
    call->Result(target + spans.spans[i].target, spans.spans[i].samples);
  }
  return target;
}

}  // namespace

void Accumulate(Draw* draw, KernelCall* call) {
  const Spans spans = MakeSpans(false, draw, call);
  auto* accumulators = MakeTarget<uint32_t>("accumulators", spans, call);
  for (size_t n = 0; n < spans.end; ++n) accumulators[n] = draw->Next() >> 4;
  call->Runs(
      [=](const Kernels& kernels) { kernels.Accumulate(spans.spans, spans.count, accumulators); });
}

void Blend(Draw* draw, KernelCall* call) {
  const Spans spans = MakeSpans(true, draw, call);
  auto* line = MakeTarget<int16_t>("line", spans, call);
  call->Runs([=](const Kernels& kernels) { kernels.Blend(spans.spans, spans.count, line); });
}

}  // namespace test::kernel_cases
