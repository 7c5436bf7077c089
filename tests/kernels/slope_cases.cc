// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/gather.h.
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {
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
  call->Runs([=](const Kernels& kernels) { kernels.MixSamples(less, more, share, count, out); });
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
  auto* out = call->Output<int16_t>("out", rows * out_stride);
  call->ResultRows(out, rows, out_stride, whole);
  call->Runs([=](const Kernels& kernels) {
    kernels.MoveSamples({in + stride + 3, stride, rows, count}, move, out, out_stride);
  });
}

}  // namespace test::kernel_cases
