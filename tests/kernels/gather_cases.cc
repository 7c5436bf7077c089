// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels that blur pixels and lines (simd/gather.h,
// simd/line_scan.h).
#include <algorithm>
#include <cstdlib>

#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
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

size_t OctantIndex(int x, int y) {
  const int high = std::max(std::abs(x), std::abs(y)), low = std::min(std::abs(x), std::abs(y));
  return size_t(high * (high + 1) / 2 + low);
}

// Returns the smallest number of bits, at least 1, such that 2^bits is no less than the sum of all
// weights.
int BitsOf(int size, const std::vector<uint16_t>& weights) {
  int64_t sum = 0;
  for (int y = -size; y <= size; ++y) {
    for (int x = -size; x <= size; ++x) sum += weights[OctantIndex(x, y)];
  }
  int bits = 1;
  while (int64_t{1} << bits < sum) ++bits;
  return bits;
}

// Returns a random disc filter; its outer weights may be zero, and its sum of weights may reach the
// maximum. The weights of any four pixels sum to at most 15 bits, since kernels weight four pixels
// together.
Disc MakeDisc(Draw* draw, KernelCall* call) {
  const int size = int(draw->Size(0, kMaxDisc, 4));
  const int pixels = (2 * size + 1) * (2 * size + 1);
  const int used = draw->Rarely(2) ? draw->Int(0, size) : size;
  const int largest = std::min(32767 / 4, (1 << 17) / pixels);
  const int most = draw->Rarely(2) ? draw->Int(1, largest) : largest;
  std::vector<uint16_t> weights(OctantIndex(size, size) + 1);
  for (int y = 0; y <= size; ++y) {
    for (int x = y; x <= size; ++x) {
      const bool zero = x > used || draw->Rarely(6);
      weights[OctantIndex(x, y)] = uint16_t(zero ? 0 : draw->Int(0, most));
    }
  }
  return {size, BitsOf(size, weights), call->Input("weights", weights)};
}

// A disc filter, the rows of a picture that the disc filters, and the pixels around these rows.
struct Filtered {
  Disc disc;
  size_t out_stride;
  SampleRows in;

  Filtered(Draw* draw, KernelCall* call) : disc(MakeDisc(draw, call)) {
    const size_t count = draw->Size(1, draw->Rarely(4) ? 400 : 60, 96);
    const size_t rows = draw->Size(1, 4, kTimedSamples / 96);
    const size_t around = size_t(disc.size), width = count + 6 * around;
    const size_t stride = width + size_t(draw->Int(0, 4));
    out_stride = count + size_t(draw->Int(0, 7));
    const int16_t* samples =
        call->Input("in", Light((rows + 2 * around - 1) * stride + width, draw), kPadding);
    call->IgnoreRows(samples + width, rows + 2 * around - 1, stride, stride - width);
    in = {samples + around * stride + 3 * around, stride, rows, count};
  }

  template <class Sample>
  Sample* Output(KernelCall* call) const {
    return call->OutputRows<Sample>("out", in.rows, out_stride, in.count);
  }
};

}  // namespace

void Accumulate(Draw* draw, KernelCall* call) {
  const Spans spans = MakeSpans(false, draw, call);
  auto* accumulators = MakeTarget<uint32_t>("accumulators", spans, call);
  for (size_t n = 0; n < spans.end; ++n) accumulators[n] = draw->Next() >> 4;
  call->Calls(&Kernels::Accumulate, spans.spans, spans.count, accumulators);
}

void FilterDisc(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  const auto encoding = AnyEncoding(draw, call);
  auto* out = filtered.Output<uint8_t>(call);
  call->Calls(&Kernels::FilterDisc, filtered.in, filtered.disc, encoding, out, filtered.out_stride);
}

void FilterDiscLayer(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  auto* out = filtered.Output<int16_t>(call);
  call->Calls(&Kernels::FilterDiscLayer, filtered.in, filtered.disc, out, filtered.out_stride);
}

// In FilterTwoDiscs, disc `less` takes most weights from disc `more`, and has a few weights where
// `more` has zeros.
void FilterTwoDiscs(Draw* draw, KernelCall* call) {
  const Filtered filtered(draw, call);
  const Disc& more = filtered.disc;
  Disc less = more;
  less.size = draw->Int(0, more.size);
  std::vector<uint16_t> weights(OctantIndex(less.size, less.size) + 1);
  for (size_t k = 0; k < weights.size(); ++k) {
    weights[k] = draw->Rarely(6) ? uint16_t(0) : more.weights[k];
    if (weights[k] == 0 && draw->Rarely(3)) weights[k] = 1;
  }
  less.bits = BitsOf(less.size, weights);
  less.weights = call->Input("weights of less", weights);
  auto *out_less = filtered.Output<int16_t>(call), *out_more = filtered.Output<int16_t>(call);
  call->Calls(&Kernels::FilterTwoDiscs, filtered.in, less, more, out_less, out_more,
              filtered.out_stride);
}

namespace {

// Returns samples of a layer, often black or white.
std::vector<int16_t> Samples(size_t count, Draw* draw) {
  std::vector<int16_t> samples = Light(count, draw);
  for (int16_t& sample : samples) sample = int16_t(sample / 2);
  return samples;
}

int16_t Between(Draw* draw, int low, int high) {
  return int16_t(draw->Rarely(4) ? (draw->Int(0, 1) == 0 ? low : high) : draw->Int(low, high));
}

}  // namespace

void MixSamples(Draw* draw, KernelCall* call) {
  const size_t count = draw->Size(1, 70, kTimedSamples), whole = SliceSamples(count);
  const int16_t* less = call->Input("less", Samples(whole, draw));
  const int16_t* more = call->Input("more", Samples(whole, draw));
  const auto shares = Filled<int16_t>(whole, [&] { return Between(draw, 0, 32767); });
  const int16_t* share = call->Input("share", shares);
  auto* out = call->Results<int16_t>("out", whole);
  call->Calls(&Kernels::MixSamples, less, more, share, count, out);
}

void MoveSamples(Draw* draw, KernelCall* call) {
  const size_t count = draw->Size(1, 70, 96), whole = SliceSamples(count);
  const size_t rows = draw->Size(1, 9, kTimedSamples / 96);
  const size_t stride = whole + 6 + size_t(draw->Int(0, 5));
  const size_t out_stride = whole + size_t(draw->Int(0, 5));
  const HalfMove move = {Between(draw, -32767, 32767), Between(draw, -32767, 32767)};
  // An eighth of the samples may be outside the range of light.
  std::vector<int16_t> values = Samples((rows + 2) * stride, draw);
  for (int16_t& value : values) {
    if (draw->Rarely(8)) value = Between(draw, -kLayerWhite, 2 * kLayerWhite);
  }
  const int16_t* in = call->Input("in", values);
  auto* out = call->OutputRows<int16_t>("out", rows, out_stride, whole);
  call->Calls(&Kernels::MoveSamples, SampleRows{in + stride + 3, stride, rows, count}, move, out,
              out_stride);
}

}  // namespace test::kernel_cases

namespace test::line_scan_cases {
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

void Blend(Draw* draw, LineScanCall* call) {
  const auto spans = kernel_cases::MakeSpans(true, draw, call);
  auto* line = kernel_cases::MakeTarget<int16_t>("line", spans, call);
  call->Calls(&LineScanKernels::Blend, spans.spans, spans.count, line);
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
  const size_t free = whole - count;
  marks.starts = call->OutputRows<uint16_t>("starts", rows, marks.stride, count, free);
  marks.edges = call->OutputRows<uint16_t>("edges", rows, marks.stride, count, free);
  marks.middles = call->OutputRows<int16_t>("middles", length, marks.stride, count, free);
  call->Calls(&LineScanKernels::FindRuns, first, step, length, count, int16_t(spread),
              int16_t(edge), marks);
}

}  // namespace test::line_scan_cases
