// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels for light and codes (simd/light.h) and for layers
// (simd/resample.h).
#include "lib/io/layers.h"
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {

void Decode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const uint8_t* codes = call->Input("codes", RandomBytes(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* light = call->Results<int16_t>("light", count);
  call->Calls(&Kernels::Decode, codes, count, encoding, light);
}

void Encode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const int16_t* light = call->Input("light", Light(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* codes = call->Results<uint8_t>("codes", count);
  call->Calls(&Kernels::Encode, light, count, encoding, codes);
}

void Finish(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const int shift = draw->Int(kLightBits + 1, 24);
  const uint32_t largest = uint32_t{255} << shift;
  const auto sums = Filled<uint32_t>(count, [&] {
    const int kind = draw->Int(0, 4);
    const uint32_t half = (uint32_t(draw->Int(0, 254)) << shift) + (1u << (shift - 1));
    return kind == 0 ? largest : kind == 1 ? half : kind == 2 ? half - 1 : draw->Next() % largest;
  });
  const uint32_t* accumulators = call->Input("accumulators", sums, kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* out = call->Results<uint8_t>("out", count);
  call->Calls(&Kernels::Finish, accumulators, count, shift, encoding, out);
}

namespace {

// Returns black, white and arbitrary samples. If `in_range` is false, samples exceed the range as
// much as the output of filters can exceed it.
std::vector<int16_t> Samples(size_t count, bool in_range, Draw* draw) {
  const int below = in_range ? 0 : -43 * 64, most = in_range ? kLayerWhite : 298 * 64;
  return Filled<int16_t>(count, [&] {
    const int kind = draw->Int(0, 3);
    return kind == 0 ? below : kind == 1 ? most : draw->Int(below, most);
  });
}

HalfBand Taps(Draw* draw) {
  if (!draw->Rarely(2)) return starfocus::kDownFilter;
  return {draw->Int(-16384, 16384), draw->Int(-16384, 16384), draw->Int(-8192, 8192)};
}

// Output memory for the even and the odd pixels of a line. The kernel may change `more` samples
// past the end of each of the two outputs.
struct Phases {
  Phases(size_t pairs, size_t more, KernelCall* call)
      : even(call->Results<int16_t>("even", 3 * pairs, more)),
        odd(call->Results<int16_t>("odd", 3 * pairs, more)) {}

  int16_t *even, *odd;
};

// Makes a call of a kernel that filters lines. The taps of the filter are 3 or `count` + 1 samples
// apart.
template <class Filter>
void FilterLine(Filter Kernels::*kernel, Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestSamples, kTimedSamples);
  const size_t step = draw->Rarely(2) ? count + 1 : 3;
  const auto samples = Samples(count + 6 * step, false, draw);
  const int16_t* in = call->Input("in", samples, kPadding) + 3 * step;
  const HalfBand taps = Taps(draw);
  const bool all = draw->Int(0, 1) != 0;
  const int16_t low = all ? INT16_MIN : int16_t{0}, high = all ? INT16_MAX : kLayerWhite;
  auto* out = call->Results<int16_t>("out", count);
  call->Calls(kernel, in, ptrdiff_t(step), taps, count, low, high, out);
}

}  // namespace

void WidenPhases(Draw* draw, KernelCall* call) {
  const size_t pairs = draw->Length(0, kLongestSamples, kTimedSamples / 6);
  const uint8_t* in = call->Input("in", RandomBytes(6 * pairs, draw));
  const auto encoding = AnyEncoding(draw, call);
  const Phases out(pairs, 0, call);
  call->Calls(&Kernels::WidenPhases, in, pairs, encoding, out.even, out.odd);
}

void DeinterleavePhases(Draw* draw, KernelCall* call) {
  const size_t pairs = draw->Length(0, kLongestSamples, kTimedSamples / 6);
  const int16_t* in = call->Input("in", Samples(6 * pairs, false, draw), kPadding);
  const Phases out(pairs, 1, call);
  call->Calls(&Kernels::DeinterleavePhases, in, pairs, out.even, out.odd);
}

void Narrow(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestSamples, kTimedSamples);
  const auto samples = Filled<int16_t>(count, [&] {
    const int kind = draw->Int(0, 4), tie = 64 * draw->Int(0, 254) + 32;
    if (kind < 2) return kind == 0 ? 0 : int{kLayerWhite};
    return kind == 2 ? tie : draw->Int(0, kLayerWhite);
  });
  const int16_t* in = call->Input("in", samples, kPadding);
  const auto encoding = AnyEncoding(draw, call);
  auto* out = call->Results<uint8_t>("out", count);
  call->Calls(&Kernels::Narrow, in, count, encoding, out);
}

void FinishLayer(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestSamples, kTimedSamples);
  const int shift = draw->Int(7, 24);
  const auto sums = Filled<uint32_t>(count, [&] {
    return draw->Int(0, 3) == 0 ? uint32_t{255} << shift : draw->Next() % (255u << shift);
  });
  const uint32_t* accumulators = call->Input("accumulators", sums, kPadding);
  auto* out = call->Results<int16_t>("out", count);
  call->Calls(&Kernels::FinishLayer, accumulators, count, shift, out);
}

void FilterHalfBand(Draw* draw, KernelCall* call) {
  FilterLine(&Kernels::FilterHalfBand, draw, call);
}

void Halve(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestSamples, kTimedSamples);
  const int16_t* even = call->Input("even", Samples(count, true, draw), kPadding);
  const int16_t* odd = call->Input("odd", Samples(count + 9, true, draw), kPadding) + 6;
  const HalfBand taps = Taps(draw);
  auto* out = call->Results<int16_t>("out", count);
  call->Calls(&Kernels::Halve, even, odd, taps, count, out);
}

void Between(Draw* draw, KernelCall* call) { FilterLine(&Kernels::Between, draw, call); }

}  // namespace test::kernel_cases
