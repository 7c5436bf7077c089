// SPDX-License-Identifier: Apache-2.0
// Compares every image kernel (pictures and depth maps) with its reference on every SIMD target of
// this machine. Also compares the reference kernels with values computed by hand.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "tests/kernels/check_kernels.h"
#include "tests/kernels/kernel_cases.h"
#include "tests/support/simd_targets.h"

namespace image_kernels_bytes_test {
namespace {

using namespace starfocus::simd;
using test::CheckValues;

TEST_CASE("image kernels: every target returns the bits of the reference and writes nothing else") {
  CHECK(test::ImageTargets()[0] == &BestImageKernels());
  test::CheckKernels<test::ImageCall>(test::image_cases::kAll, ReferenceImageKernels(),
                                      test::ImageTargets());
}

TEST_CASE("image kernels: on every target, HalvesToDepth converts all half floats correctly") {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  std::vector<uint16_t> halves(65536);
  for (size_t k = 0; k < halves.size(); ++k) halves[k] = uint16_t(k);
  for (const ImageKernels* kernels : test::ImageTargets()) {
    std::vector<float> z(halves.size());
    kernels->HalvesToDepth(halves.data(), z.size(), z.data());
    int wrong = 0;
    for (size_t k = 0; k < z.size(); ++k) {
      const int exponent = int(k >> 10) & 31, fraction = int(k) & 1023;
      const double size =
          exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
      if (exponent == 31) {
        const bool right = fraction != 0 ? std::isnan(z[k]) : z[k] == (k >= 32768 ? -kInf : kInf);
        wrong += right ? 0 : 1;
      } else {
        wrong += double(z[k]) == (k >= 32768 ? -size : size) ? 0 : 1;
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("image kernels: DepthToDisparity returns values computed by hand") {
  const ImageKernels& kernels = ReferenceImageKernels();
  const DepthRule metres = {4000, -1, 65535, true, -10, 10};
  const float z[] = {1000, 4000, 0, 65535, 500};
  int16_t out[5];
  CHECK(kernels.DepthToDisparity(z, 5, metres, out) == kUnknownDepth);
  // The third depth value is a distance of 0, which has no valid disparity.
  CheckValues("metres", out, {3 * 64, 0, kNoSurface, kNoSurface, 7 * 64});
  const DepthRule linear = {0.5f, 2, NAN, false, -10, 10};
  const float steps[] = {0, 1, 16, 17};
  CHECK(kernels.DepthToDisparity(steps, 3, linear, out) == 0);
  CheckValues("linear", out, {2 * 64, 160, 10 * 64});
  CHECK(kernels.DepthToDisparity(steps, 4, linear, out) == kDepthOutside);
}

TEST_CASE("image kernels: BlendRows and UpsampleRow return values computed by hand") {
  const ImageKernels& kernels = ReferenceImageKernels();
  const int16_t a[] = {0, 0, 0, kNoSurface}, b[] = {96, 97, -96, 5};
  int16_t out[4];
  kernels.BlendRows(a, b, 4, 64, out);
  CheckValues("a quarter", out, {24, 0, -24, kNoSurface});
  kernels.BlendRows(a, b, 4, 128, out);
  CheckValues("half", out, {48, 97, -48, 5});
  const int16_t row[] = {0, 80, 1000};
  const uint32_t columns[] = {7 * 256, 7 * 256 + 128, 8 * 256 + 127, 8 * 256 + 128};
  kernels.UpsampleRow(row, columns, 4, 7, out);
  CheckValues("columns", out, {0, 40, 80, 1000});
}

}  // namespace
}  // namespace image_kernels_bytes_test
