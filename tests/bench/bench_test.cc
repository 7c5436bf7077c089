// SPDX-License-Identifier: Apache-2.0
// Tests the metrics of the bench with pictures and numbers whose results are known, and the rival
// of its comparison of speed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "examples/lab/bench/metrics.h"
#include "examples/lab/bench/shift_and_add.h"
#include "simd/kernels.h"

namespace bench_test {
namespace {

using namespace starfocus::bench;
using starfocus::FloatMap;
using starfocus::Image;

Image Gray(int width, int height, int value) {
  Image image(width, height);
  for (uint8_t& sample : image.pixels) sample = uint8_t(value);
  return image;
}

TEST_CASE("The PSNR of a known difference is exact") {
  const Image a = Gray(40, 20, 100), b = Gray(40, 20, 105);
  CHECK(Psnr(a, a) == kBestPsnr);
  CHECK(Psnr(a, b) == doctest::Approx(20 * std::log10(255.0 / 5)));
  Image c = a;
  c.pixels[0] = 255;  // one of 2400 samples differs
  CHECK(Psnr(a, c) == doctest::Approx(10 * std::log10(255.0 * 255 * 2400 / (155 * 155))));
}

TEST_CASE("WorstBlockPsnr finds the worst block, even if the picture's edge cuts the block") {
  const Image a = Gray(35, 18, 50);
  Image b = a;
  CHECK(WorstBlockPsnr(a, b) == kBestPsnr);
  b.row(17)[3 * 34] = 60;  // pixel of the last block, which has 3x2 pixels
  CHECK(WorstBlockPsnr(a, b) == doctest::Approx(10 * std::log10(255.0 * 255 * 18 / 100)));
}

TEST_CASE("MaskedPsnr compares only the pixels of the mask") {
  const Image a = Gray(4, 1, 10);
  Image b = a;
  b.pixels[0] = 20;
  CHECK(MaskedPsnr(a, b, {0, 1, 1, 1}) == kBestPsnr);
  CHECK(MaskedPsnr(a, b, {1, 0, 0, 0}) == doctest::Approx(10 * std::log10(255.0 * 255 * 3 / 100)));
  CHECK(MaskedPsnr(a, b, {0, 0, 0, 0}) == kBestPsnr);
}

TEST_CASE("SSIM is 1 for equal, exact for uniformly grey and negative for inverted pictures") {
  Image a(32, 24);
  for (size_t i = 0; i < a.pixels.size(); ++i) a.pixels[i] = uint8_t(i / 3 * 37 % 251);
  CHECK(Ssim(a, a) == doctest::Approx(1));
  Image inverted = a;
  for (uint8_t& sample : inverted.pixels) sample = uint8_t(255 - sample);
  CHECK(Ssim(a, inverted) < 0);
  // Constant pictures differ only in luminance.
  const double c1 = 6.5025, expected = (2 * 100 * 120 + c1) / (100 * 100 + 120 * 120 + c1);
  CHECK(Ssim(Gray(16, 16, 100), Gray(16, 16, 120)) == doctest::Approx(expected).epsilon(1e-3));
  CHECK(Ssim(Gray(5, 5, 1), Gray(5, 5, 200)) == 1);
}

TEST_CASE("EdgeBand marks the given number of rows and columns on each side of a step") {
  FloatMap map;
  map.width = 12;
  map.height = 5;
  map.values.assign(60, 0.0f);
  CHECK(EdgeBand(map, 3) == Mask(60, 0));
  for (int y = 0; y < 5; ++y) {
    for (int x = 6; x < 12; ++x) map.values[size_t(12 * y + x)] = 2;
  }
  const Mask band = EdgeBand(map, 2);
  for (int x = 0; x < 12; ++x) CHECK(int{band[size_t(24 + x)]} == int{x >= 3 && x <= 8});
  for (float& value : map.values) value /= 2;  // a step of 1 is not a depth edge
  CHECK(EdgeBand(map, 2) == Mask(60, 0));
  map.values[0] = 5;
  const Mask corner = EdgeBand(map, 0);
  CHECK(int{corner[0]} + corner[1] + corner[12] == 3);
  CHECK(int{corner[13]} == 0);
}

TEST_CASE("Median, spread and quantiles of known numbers are exact") {
  CHECK(Median({}) == 0);
  CHECK(Median({3, 1, 2}) == 2);
  CHECK(Median({4, 1, 2, 3}) == 2.5);
  CHECK(Spread({10, 10, 10}) == 0);
  CHECK(Spread({10, 12, 9, 100, 10}) == doctest::Approx(0.1));
  CHECK(Quantile({4, 0, 2}, 0) == 0);
  CHECK(Quantile({4, 0, 2}, 0.75) == 3);
  CHECK(Quantile({4, 0, 2}, 1) == 4);
}

TEST_CASE("Shift-and-add of a plane in focus is the centre view, on every SIMD target") {
  constexpr double kFocus = 2.5;
  const auto ramp = [](double x, double y) { return int(60 + 2 * x + 4 * y); };
  Field field;
  field.transfer = STARFOCUS_TRANSFER_NONE;
  for (int k = 0; k < 17; ++k) {
    double u = 0, v = 0;
    starfocus_view_position(k, &u, &v, nullptr);
    Image view(41, 23);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        std::fill_n(view.row(y) + 3 * x, 3, uint8_t(ramp(x + u * kFocus, y + v * kFocus)));
      }
    }
    field.data.views.push_back(view);
  }
  std::vector<std::string> targets = {""};
  for (size_t i = 0; starfocus::simd::KernelsOfTarget(i) != nullptr; ++i) {
    targets.push_back(starfocus::simd::KernelsOfTarget(i)->name);
  }
  Image first;
  for (const std::string& target : targets) {
    Image out(41, 23);
    ShiftAndAdd(field, 17, kFocus, target).Run(&out);
    for (int y = 3; y < out.height - 3; ++y) {  // farther out, views repeat their edges
      for (int x = 3; x < out.width - 3; ++x) CHECK(out.row(y)[3 * x] == ramp(x, y));
    }
    if (first.pixels.empty()) first = out;
    CHECK(out.pixels == first.pixels);
  }
}

}  // namespace
}  // namespace bench_test
