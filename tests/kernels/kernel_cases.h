// SPDX-License-Identifier: Apache-2.0
// Test and benchmark cases, one for each kernel. A case makes calls with any size and contents for
// the test, and one call of a typical size for the benchmark.
#ifndef STARFOCUS_TESTS_KERNELS_KERNEL_CASES_H_
#define STARFOCUS_TESTS_KERNELS_KERNEL_CASES_H_

#include "tests/kernels/kernel_call.h"

namespace test {

// A case for one kernel of a table.
template <class Table>
struct CaseOf {
  const char* kernel;
  void (*make)(Draw* draw, CallOf<Table>* call);
  // Replaces the kernel in `table` by a function that throws KernelCalled.
  void (*replace)(Table* table);
};

struct KernelCalled {};

template <class Table, class Result, class... Arguments>
void ThrowIn(Result (*Table::*kernel)(Arguments...), Table* table) {
  table->*kernel = [](Arguments...) -> Result { throw KernelCalled(); };
}

// Each case is defined in the file of its family, such as cells_cases.cc. A kernel without a case
// causes a linker error.
#define STARFOCUS_DECLARE_CASE(Kernel) void Kernel(Draw* draw, CallOf<Table>* call);
#define STARFOCUS_LIST_CASE(Kernel) \
  {#Kernel, Kernel, [](Table* table) { ThrowIn(&Table::Kernel, table); }},
#define STARFOCUS_CASES(cases, OfTable, List)                            \
  namespace cases {                                                      \
  using namespace starfocus::simd;                                       \
  using Table = OfTable;                                                 \
  List(STARFOCUS_DECLARE_CASE) inline constexpr CaseOf<Table> kAll[] = { \
      List(STARFOCUS_LIST_CASE)};                                        \
  }
STARFOCUS_CASES(kernel_cases, Kernels, STARFOCUS_KERNELS)
STARFOCUS_CASES(depth_cases, DepthKernels, STARFOCUS_DEPTH_KERNELS)
STARFOCUS_CASES(image_cases, ImageKernels, STARFOCUS_IMAGE_KERNELS)
STARFOCUS_CASES(line_scan_cases, LineScanKernels, STARFOCUS_LINE_SCAN_KERNELS)
STARFOCUS_CASES(video_cases, VideoKernels, STARFOCUS_VIDEO_KERNELS)
STARFOCUS_CASES(word_cases, WordKernels, STARFOCUS_WORD_KERNELS)
#undef STARFOCUS_CASES
#undef STARFOCUS_DECLARE_CASE
#undef STARFOCUS_LIST_CASE

// Number of samples in a timed kernel call, unless a case uses another number.
inline constexpr int kTimedSamples = 3 * 1024;

// Longest rows in kernel calls: more than two of the widest vectors, so that all remainders occur.
inline constexpr int kLongestBytes = 2 * 64 + 3, kLongestSamples = 2 * 32 + 3;

// Returns samples of light that are black, white, or arbitrary.
inline std::vector<int16_t> Light(size_t count, Draw* draw) {
  constexpr int kWhite = starfocus::simd::kLightWhite;
  return Filled<int16_t>(count, [&] {
    const int kind = draw->Int(0, 3);
    return kind == 0 ? 0 : kind == 1 ? kWhite : draw->Int(0, kWhite);
  });
}

// Returns random tables for conversion between codes and light, or null tables, which stand for
// linear codes. At most one code begins in each step of a table.
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
  const std::vector<int16_t> light = Light(256, draw);
  std::vector<int16_t> samples;
  for (const int16_t value : light) samples.push_back(int16_t((value + 1) >> 1));
  return {call->Input("light of codes", light), call->Input("entries", entries),
          call->Input("samples of codes", samples)};
}

// Returns disparities with runs and edges. A few of the disparities are arbitrary.
inline std::vector<int16_t> Disparities(size_t count, Draw* draw) {
  int value = draw->Int(-2000, 2000);
  return Filled<int16_t>(count, [&] {
    if (draw->Int(0, 5) == 0) value += draw->Int(-200, 200);
    return draw->Rarely(60) ? draw->Int(-32000, 32000) : value;
  });
}

}  // namespace test

#endif  // STARFOCUS_TESTS_KERNELS_KERNEL_CASES_H_
