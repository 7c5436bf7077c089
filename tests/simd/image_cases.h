// SPDX-License-Identifier: Apache-2.0
// A case for each kernel of pictures and depth maps, as kernel_cases.h has for those of the engine.
#ifndef STARFOCUS_TESTS_SIMD_IMAGE_CASES_H_
#define STARFOCUS_TESTS_SIMD_IMAGE_CASES_H_

#include "simd/image_kernels.h"
#include "tests/simd/kernel_call.h"

namespace test {

namespace image_cases {
using namespace starfocus::simd;
#define STARFOCUS_DECLARE_CASE(Kernel) void Kernel(Draw* draw, ImageCall* call);
STARFOCUS_IMAGE_KERNELS(STARFOCUS_DECLARE_CASE)
#undef STARFOCUS_DECLARE_CASE
}  // namespace image_cases

struct ImageCase {
  const char* kernel;
  void (*make)(Draw* draw, ImageCall* call);
};

inline constexpr ImageCase kImageCases[] = {
#define STARFOCUS_LIST_CASE(Kernel) {#Kernel, image_cases::Kernel},
    STARFOCUS_IMAGE_KERNELS(STARFOCUS_LIST_CASE)
#undef STARFOCUS_LIST_CASE
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SIMD_IMAGE_CASES_H_
