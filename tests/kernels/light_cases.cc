// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/light.h.
#include "tests/kernels/kernel_cases.h"

namespace test::kernel_cases {

void Decode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const uint8_t* codes = call->Input("codes", RandomBytes(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* light = call->Results<int16_t>("light", count);
  call->Runs([=](const Kernels& kernels) { kernels.Decode(codes, count, encoding, light); });
}

void Encode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const int16_t* light = call->Input("light", Light(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* codes = call->Results<uint8_t>("codes", count);
  call->Runs([=](const Kernels& kernels) { kernels.Encode(light, count, encoding, codes); });
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
  call->Runs(
      [=](const Kernels& kernels) { kernels.Finish(accumulators, count, shift, encoding, out); });
}

}  // namespace test::kernel_cases
