// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/pixels.h.
#include "simd/pixels.h"
#include "tests/kernels/kernel_cases.h"

namespace test::image_cases {
namespace {

constexpr int kLongestPixels = 2 * 64 + 67;

}  // namespace

void PixelsToRgb(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestPixels, 1024);
  const size_t step = draw->Size(3, 4, 3);
  const bool blue_first = draw->Int(0, 1) != 0;
  // The memory of `pixels` ends with the colours of the last pixel, even if pixels have a fourth
  // byte.
  const uint8_t* pixels = call->Input("pixels", RandomBytes(step * (count - 1) + 3, draw));
  auto* rgb = call->Results<uint8_t>("rgb", 3 * count);
  call->Runs([=](const ImageKernels& kernels) {
    kernels.PixelsToRgb(pixels, count, step, blue_first, rgb);
  });
}

void RgbToPixels(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestPixels, 1024);
  const size_t step = draw->Size(3, 4, 3);
  const bool blue_first = draw->Int(0, 1) != 0;
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* pixels = call->Results<uint8_t>("pixels", step * count);
  call->Runs([=](const ImageKernels& kernels) {
    kernels.RgbToPixels(rgb, count, step, blue_first, pixels);
  });
}

}  // namespace test::image_cases
