// SPDX-License-Identifier: Apache-2.0
// A case for each depth kernel, as kernel_cases.h has for those of the engine.
#ifndef STARFOCUS_TESTS_SIMD_DEPTH_CASES_H_
#define STARFOCUS_TESTS_SIMD_DEPTH_CASES_H_

#include "simd/depth_kernels.h"
#include "tests/simd/kernel_call.h"

namespace test {

namespace depth_cases {
using namespace starfocus::simd;
#define STARFOCUS_DECLARE_CASE(Kernel) void Kernel(Draw* draw, DepthCall* call);
STARFOCUS_DEPTH_KERNELS(STARFOCUS_DECLARE_CASE)
#undef STARFOCUS_DECLARE_CASE
}  // namespace depth_cases

struct DepthCase {
  const char* kernel;
  void (*make)(Draw* draw, DepthCall* call);
};

inline constexpr DepthCase kDepthCases[] = {
#define STARFOCUS_LIST_CASE(Kernel) {#Kernel, depth_cases::Kernel},
    STARFOCUS_DEPTH_KERNELS(STARFOCUS_LIST_CASE)
#undef STARFOCUS_LIST_CASE
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SIMD_DEPTH_CASES_H_
