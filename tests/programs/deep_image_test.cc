// SPDX-License-Identifier: Apache-2.0
// Tests the conversions of pictures with more than 8 bits against values of the standards.
#include "platform/deep_image.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

namespace starfocus::deep_image_test {
namespace {

constexpr int32_t kSrgb = STARFOCUS_TRANSFER_SRGB, kLinear = STARFOCUS_TRANSFER_NONE,
                  kPq = STARFOCUS_TRANSFER_PQ, kHlg = STARFOCUS_TRANSFER_HLG;
constexpr uint16_t kOne = 0x3c00, kHalfNan = 0x7e00, kHalfInfinity = 0x7c00;

DeepImage Make(int channels, bool is_half, int32_t transfer, std::vector<uint16_t> samples) {
  DeepImage image(static_cast<int>(samples.size()) / channels, 1, channels);
  image.is_half = is_half;
  image.transfer = transfer;
  image.samples = std::move(samples);
  return image;
}

std::vector<uint16_t> Halves(std::initializer_list<float> values) {
  std::vector<uint16_t> halves;
  for (const float value : values) halves.push_back(HalfOfFloat(value));
  return halves;
}

TEST_CASE("halves: every half has the value of IEEE 754, and is its own nearest half") {
  for (int bits = 0; bits < 65536; ++bits) {
    const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
    if (exponent == 31) continue;
    const double size = exponent == 0 ? mantissa * std::pow(2.0, -24)
                                      : (1 + mantissa / 1024.0) * std::pow(2.0, exponent - 15);
    const float value = FloatOfHalf(static_cast<uint16_t>(bits));
    if (value != (bits < 32768 ? size : -size)) FAIL_CHECK(bits);
    if (HalfOfFloat(value) != bits) FAIL_CHECK(bits);
  }
  CHECK(std::isinf(FloatOfHalf(kHalfInfinity)));
  CHECK(std::isnan(FloatOfHalf(kHalfNan)));
  CHECK(std::isnan(FloatOfHalf(HalfOfFloat(std::numeric_limits<float>::quiet_NaN()))));
}

TEST_CASE("halves: values between two halves round to the nearest, and the middle to the even") {
  for (int bits = 0; bits < kHalfInfinity; ++bits) {
    const float low = FloatOfHalf(static_cast<uint16_t>(bits));
    const float high = bits + 1 == kHalfInfinity ? 65536 : FloatOfHalf(uint16_t(bits + 1));
    const float middle = low + (high - low) / 2;  // exact
    if (HalfOfFloat(middle) != bits + bits % 2) FAIL_CHECK(bits);
    if (HalfOfFloat(std::nextafter(middle, 0.0F)) != bits) FAIL_CHECK(bits);
    if (HalfOfFloat(std::nextafter(middle, 1e6F)) != bits + 1) FAIL_CHECK(bits);
    if (HalfOfFloat(-middle) != (bits + bits % 2) + 32768) FAIL_CHECK(bits);
  }
  CHECK(HalfOfFloat(1e30F) == kHalfInfinity);
  CHECK(HalfOfFloat(1e-30F) == 0);
}

TEST_CASE("transfers: codes give the light of the standards") {
  // Values of IEC 61966-2-1, of SMPTE ST 2084 in cd/m2 divided by 203, and of ITU-R BT.2100, table
  // 5, divided by the light of the scene at code 0.75.
  constexpr double kHlgWhite = 0.26496256042100724;
  const struct {
    int32_t transfer;
    double code, light;
  } rows[] = {
      {kSrgb, 0, 0},
      {kSrgb, 0.04045, 0.0031308049535603713},
      {kSrgb, 0.5, 0.21404114048223255},
      {kSrgb, 1, 1},
      {kLinear, 0.3, 0.3},
      {kPq, 0, 0},
      {kPq, 0.5, 92.24570899406527 / 203},
      {kPq, 0.5806888810416109, 1},
      {kPq, 1, 10000.0 / 203},
      {kHlg, 0, 0},
      {kHlg, 0.5, 1.0 / 12 / kHlgWhite},
      {kHlg, 0.75, 1},
      {kHlg, 1, 1 / kHlgWhite},
  };
  for (const auto& row : rows) {
    CAPTURE(row.transfer);
    CAPTURE(row.code);
    CHECK(LightOfCode(row.transfer, row.code) == doctest::Approx(row.light).epsilon(1e-6));
    CHECK(CodeOfLight(row.transfer, row.light) == doctest::Approx(row.code).epsilon(1e-6));
  }
}

TEST_CASE("transfers: each code of 16 bits is the code of its light, and light grows with codes") {
  for (const int32_t transfer : {kSrgb, kLinear, kPq, kHlg}) {
    CAPTURE(transfer);
    double last = -1;
    for (int code = 0; code < 65536; ++code) {
      const double light = LightOfCode(transfer, code / 65535.0);
      // The first codes of PQ are darker than numbers of double precision tell apart.
      if (std::fabs(CodeOfLight(transfer, light) * 65535 - code) > 0.01 && code > 4) {
        FAIL_CHECK(code);
      }
      if (light < last) FAIL_CHECK(code);
      last = light;
    }
  }
}

TEST_CASE("deep images: codes become premultiplied halves, and the same codes again") {
  for (const int32_t transfer : {kSrgb, kLinear, kHlg}) {
    CAPTURE(transfer);
    const DeepImage codes =
        Make(4, false, transfer, {65535, 32768, 0, 65535, 65535, 20000, 10000, 32768, 0, 0, 0, 0});
    const DeepImage half = ToHalf(codes);
    CHECK(half.is_half);
    const auto at = [&half](size_t k) { return FloatOfHalf(half.samples[k]); };
    const double white = LightOfCode(transfer, 1), share = 32768 / 65535.0;
    CHECK(at(0) == doctest::Approx(white).epsilon(5e-4));
    CHECK(at(4) == doctest::Approx(white * share).epsilon(5e-4));
    CHECK(at(5) == doctest::Approx(LightOfCode(transfer, 20000 / 65535.0) * share).epsilon(5e-4));
    CHECK(at(7) == doctest::Approx(share).epsilon(5e-4));
    CHECK(half.samples[3] == kOne);
    ClippedSamples clipped;
    const DeepImage again = ToCodes(half, transfer, &clipped);
    // Halves have 11 bits: a code changes by at most 2^-11 of itself, twice for partial alpha.
    for (size_t k = 0; k < codes.samples.size(); ++k) {
      CHECK(std::abs(again.samples[k] - codes.samples[k]) <= codes.samples[k] / 900);
    }
    CHECK(again.transfer == transfer);
  }
}

TEST_CASE("deep images: samples that codes cannot store are clipped and counted") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  ClippedSamples clipped;
  const DeepImage codes = ToCodes(
      Make(4, true, kLinear,
           Halves({2, 1, -0.5F, 1, infinity, nan, 0.25F, 1, 0.5F, 0, 0, 0, 0.6F, 0.25F, 0, 0.5F})),
      kLinear, &clipped);
  // Infinite light is also brighter than white. The pixel of alpha 0 glows. The last pixel has
  // light of 1.2 and 0.5 before the multiplication with alpha.
  CHECK(std::tuple(clipped.bright, clipped.negative, clipped.not_finite, clipped.glowing) ==
        std::tuple(3, 1, 2, 1));
  CHECK(codes.samples == std::vector<uint16_t>{65535, 65535, 0, 65535, 65535, 0, 16384, 65535, 0, 0,
                                               0, 0, 65535, 32768, 0, 32768});
  CHECK(Describe(clipped, "white") ==
        "3 samples brighter than white, 1 negative samples, 2 samples that are infinite or not a "
        "number, 1 samples of light in transparent pixels");
  ClippedSamples none;
  ToCodes(Make(3, true, kLinear, Halves({49, 3.7F, 0})), kPq, &none);
  ToCodes(Make(3, true, kLinear, Halves({1, 3.7F, 0})), kHlg, &none);
  CHECK_FALSE(none.any());
  ToCodes(Make(3, true, kLinear, Halves({50, 3.7F, 0})), kPq, &none);
  ToCodes(Make(3, true, kLinear, Halves({4, 3.7F, 0})), kHlg, &none);
  CHECK(none.bright == 2);
}

TEST_CASE("deep images: the picture of 8 bits is rounded, or a rendition clipped at white") {
  std::vector<uint16_t> all(65536 * 3);
  for (size_t k = 0; k < all.size(); ++k) all[k] = static_cast<uint16_t>(k / 3);
  for (const int32_t transfer : {kSrgb, kLinear}) {
    const Image rounded = ToImage(Make(3, false, transfer, all));
    for (int code = 0; code < 65536; ++code) {
      const int byte = rounded.pixels[3 * size_t(code)];
      if (byte != std::lround(code / 257.0)) FAIL_CHECK(code);
    }
  }
  // Codes of white in PQ and HLG, and of light of 0.21404 (sRGB 0.5, byte 128) and 4 times white.
  const Image pq = ToImage(Make(3, false, kPq, {38055, 27985, 47785}));
  CHECK(std::vector<int>(pq.pixels.begin(), pq.pixels.end()) == std::vector<int>{255, 128, 255});
  const Image hlg = ToImage(Make(3, false, kHlg, {49151, 27032, 65535}));
  CHECK(std::vector<int>(hlg.pixels.begin(), hlg.pixels.end()) == std::vector<int>{255, 128, 255});
  const Image half =
      ToImage(Make(4, true, kLinear, Halves({1, 0.5F, 7, 1, -1, std::nanf(""), 0, 0})));
  CHECK(std::vector<int>(half.pixels.begin(), half.pixels.end()) ==
        std::vector<int>{255, 188, 255, 0, 0, 0});
}

TEST_CASE("deep images: opaque alpha is removed, and the largest light is finite") {
  DeepImage opaque = Make(4, false, kSrgb, {1, 2, 3, 65535, 4, 5, 6, 65535});
  CHECK_FALSE(DropOpaqueAlpha(&opaque));
  CHECK(opaque.samples == std::vector<uint16_t>{1, 2, 3, 4, 5, 6});
  CHECK(opaque.channels == 3);
  DeepImage clear = Make(4, true, kLinear, Halves({9, 2, 3, 1, 4, 5, 6, 0.999F}));
  CHECK(DropOpaqueAlpha(&clear));
  CHECK(clear.channels == 4);
  CHECK(LargestLight(clear) == 9);
  CHECK(LargestLight(Make(3, true, kLinear, {0xc000, kHalfNan, kHalfInfinity})) == 0);
  CHECK(LargestLight(Make(3, false, kPq, {0, 65535, 9})) == doctest::Approx(10000.0 / 203));
}

}  // namespace
}  // namespace starfocus::deep_image_test
