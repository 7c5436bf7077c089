// SPDX-License-Identifier: Apache-2.0
// Test and benchmark calls of the kernels in simd/pixels.h.
#include "simd/pixels.h"
#include "tests/simd/kernel_cases.h"

namespace test::image_cases {
namespace {

constexpr int kLongestPixels = 2 * 64 + 67;

PixelOrder AnyOrder(Draw* draw) { return {size_t(draw->Int(3, 4)), draw->Int(0, 1) != 0}; }

}  // namespace

void PixelsToRgb(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestPixels, 1024);
  const PixelOrder order = AnyOrder(draw);
  // The memory of `pixels` ends with the colours of the last pixel, even if pixels have a fourth
  // byte.
  const uint8_t* pixels = call->Input("pixels", RandomBytes(order.step * (count - 1) + 3, draw));
  auto* rgb = call->Results<uint8_t>("rgb", 3 * count);
  call->Runs([=](const ImageKernels& kernels) { kernels.PixelsToRgb(pixels, count, order, rgb); });
}

void RgbToPixels(Draw* draw, ImageCall* call) {
  const size_t count = draw->Length(1, kLongestPixels, 1024);
  const PixelOrder order = AnyOrder(draw);
  const uint8_t* rgb = call->Input("rgb", RandomBytes(3 * count, draw));
  auto* pixels = call->Results<uint8_t>("pixels", order.step * count);
  call->Runs([=](const ImageKernels& kernels) { kernels.RgbToPixels(rgb, count, order, pixels); });
}

}  // namespace test::image_cases
