// SPDX-License-Identifier: Apache-2.0
// Cases of the kernels of simd/light.h.
#include "tests/simd/kernel_cases.h"

namespace test::kernel_cases {

using starfocus::simd::Encoding;
using starfocus::simd::kEncodeBits;
using starfocus::simd::kEncodeEntries;
using starfocus::simd::kEncodeStep;
using starfocus::simd::Kernels;
using starfocus::simd::kLightBits;
using starfocus::simd::kLightWhite;
using starfocus::simd::kPadding;

void Decode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const uint8_t* codes = call->Input("codes", Bytes(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* light = call->Output<int16_t>("light", count);
  call->Result(light, count);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    kernels.Decode(codes, count, encoding, light);
    return 0;
  };
}

void Encode(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const int16_t* light = call->Input("light", Light(count, draw), kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* codes = call->Output<uint8_t>("codes", count);
  call->Result(codes, count);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    kernels.Encode(light, count, encoding, codes);
    return 0;
  };
}

void Finish(Draw* draw, KernelCall* call) {
  const size_t count = draw->Length(1, kLongestBytes, kTimedSamples);
  const int shift = draw->Int(kLightBits + 1, 24);
  const uint32_t largest = uint32_t{255} << shift;
  std::vector<uint32_t> sums(count);
  for (uint32_t& sum : sums) {
    const int kind = draw->Int(0, 4);
    const uint32_t half = (uint32_t(draw->Int(0, 254)) << shift) + (1u << (shift - 1));
    sum = kind == 0 ? largest : kind == 1 ? half : kind == 2 ? half - 1 : draw->Next() % largest;
  }
  const uint32_t* accumulators = call->Input("accumulators", sums, kPadding);
  const Encoding encoding = AnyEncoding(draw, call);
  auto* out = call->Output<uint8_t>("out", count);
  call->Result(out, count);
  call->run = [=](const Kernels& kernels) -> uint64_t {
    kernels.Finish(accumulators, count, shift, encoding, out);
    return 0;
  };
}

}  // namespace test::kernel_cases
