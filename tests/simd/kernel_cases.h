// SPDX-License-Identifier: Apache-2.0
// A case for each kernel: it makes calls of any size and contents for the test, and one call of
// ordinary size for the bench.
#ifndef STARFOCUS_TESTS_SIMD_KERNEL_CASES_H_
#define STARFOCUS_TESTS_SIMD_KERNEL_CASES_H_

#include "simd/kernels.h"
#include "tests/simd/kernel_call.h"

namespace test {

// Each case is defined beside those of its family, in spans_cases.cc and so on. A kernel of the
// table without a case is an error of the linker.
namespace kernel_cases {
using namespace starfocus::simd;
#define STARFOCUS_DECLARE_CASE(Kernel) void Kernel(Draw* draw, KernelCall* call);
STARFOCUS_KERNELS(STARFOCUS_DECLARE_CASE)
#undef STARFOCUS_DECLARE_CASE
}  // namespace kernel_cases

struct KernelCase {
  const char* kernel;
  void (*make)(Draw* draw, KernelCall* call);
};

inline constexpr KernelCase kKernelCases[] = {
#define STARFOCUS_LIST_CASE(Kernel) {#Kernel, kernel_cases::Kernel},
    STARFOCUS_KERNELS(STARFOCUS_LIST_CASE)
#undef STARFOCUS_LIST_CASE
};

// Samples that a call of the bench works on, if its kernel does not say otherwise.
inline constexpr int kTimedSamples = 3 * 1024;

// Lengths that reach past two of the widest vectors, with all tails.
inline constexpr int kLongestBytes = 2 * 64 + 3, kLongestSamples = 2 * 32 + 3;

// Any bytes, or black and white ones.
inline std::vector<uint8_t> Bytes(size_t count, Draw* draw) { return RandomBytes(count, draw); }

// Any light, or black and white.
inline std::vector<int16_t> Light(size_t count, Draw* draw) {
  constexpr int kWhite = starfocus::simd::kLightWhite;
  std::vector<int16_t> light(count);
  for (int16_t& value : light) {
    const int kind = draw->Int(0, 3);
    value = int16_t(kind == 0 ? 0 : kind == 1 ? kWhite : draw->Int(0, kWhite));
  }
  return light;
}

// Light that is the code itself, or any table of it: codes follow each other at random, one at most
// begins in each step.
inline starfocus::simd::Encoding AnyEncoding(Draw* draw, KernelCall* call) {
  using starfocus::simd::kEncodeBits, starfocus::simd::kEncodeStep;
  if (draw->Int(0, 1) == 0) return {nullptr, nullptr};
  std::vector<uint16_t> entries(starfocus::simd::kEncodeEntries);
  int code = 0;
  for (uint16_t& entry : entries) {
    const bool begins = code < 255 && draw->Int(0, 15) == 0;
    const int from = begins ? draw->Int(0, kEncodeStep - 1) : kEncodeStep;
    if (from == 0) ++code;
    const bool inside = from > 0 && from < kEncodeStep;
    entry = uint16_t((code << kEncodeBits) + (inside ? (1 << kEncodeBits) - from : 0));
    if (inside) ++code;
  }
  return {call->Input("light of codes", Light(256, draw)), call->Input("entries", entries)};
}

// Disparities with runs and edges, also at the ends of the range.
inline std::vector<int16_t> Disparities(size_t count, Draw* draw) {
  std::vector<int16_t> row(count);
  int value = draw->Int(-2000, 2000);
  for (int16_t& disparity : row) {
    if (draw->Int(0, 5) == 0) value += draw->Int(-200, 200);
    disparity = int16_t(draw->Rarely(60) ? draw->Int(-32000, 32000) : value);
  }
  return row;
}

}  // namespace test

#endif  // STARFOCUS_TESTS_SIMD_KERNEL_CASES_H_
