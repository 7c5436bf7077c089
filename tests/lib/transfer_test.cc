// SPDX-License-Identifier: Apache-2.0
// Tests conversions between codes and light, and averages of light, with both transfer functions.
#include "lib/base/transfer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/transfer_curve.h"

namespace transfer_test {
namespace {

constexpr starfocus_transfer kTransfers[] = {STARFOCUS_TRANSFER_SRGB, STARFOCUS_TRANSFER_NONE};

uint8_t CodeOf(int light, starfocus_transfer transfer) {
  const auto level = int16_t(light);
  uint8_t code = 0;
  starfocus::simd::ReferenceKernels().Encode(&level, 1, starfocus::TransferOf(transfer), &code);
  return code;
}

TEST_CASE("transfer: the light of every code follows the curve and converts back to the code") {
  for (const starfocus_transfer transfer : kTransfers) {
    const starfocus::simd::Encoding& tables = starfocus::TransferOf(transfer);
    for (int code = 0; code < 256; ++code) {
      CAPTURE(code);
      CHECK(std::fabs(tables.light[code] - 128 * test::LightOf(code, transfer)) <= 0.5001);
      CHECK(CodeOf(tables.light[code], transfer) == code);
      if (code > 0) CHECK(tables.light[code] - tables.light[code - 1] >= 8);
    }
    CHECK(tables.light[0] == 0);
    CHECK(tables.light[255] == starfocus::kLightWhite);
  }
}

TEST_CASE("transfer: every level of light is rounded to the nearest code") {
  for (const starfocus_transfer transfer : kTransfers) {
    for (int light = 0; light <= starfocus::kLightWhite; ++light) {
      const double exact = test::CodeOf(light / 128.0, transfer);
      if (std::fabs(CodeOf(light, transfer) - exact) > 0.5 + 1e-9) {
        CAPTURE(light);
        CHECK(int(CodeOf(light, transfer)) == doctest::Approx(exact));
      }
    }
  }
}

// Returns a scene at one disparity, with the code code_at(x, y) in all channels.
template <class CodeAt>
test::Scene FlatScene(int width, int height, double disparity, const CodeAt& code_at) {
  test::Scene scene = test::EmptyScene(width, height, 1, float(disparity), float(disparity));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(code_at(x, y)));
  }
  return scene;
}

test::Refocused RefocusFlat(const test::Scene& scene, double blur, starfocus_mode mode,
                            starfocus_transfer transfer,
                            starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO) {
  test::Config config = test::ConfigFor(scene, 32);
  config.transfer = transfer;
  starfocus::Params params = test::Params(double(scene.disparity_min) - blur, 1, mode, renderer);
  return test::RefocusScene(scene, config, params);
}

// A ramp that rises by one code every few pixels would show bands if light had only 8 bits.
TEST_CASE("transfer: a ramp of dark codes stays monotone at every focus") {
  constexpr int kCodes = 41, kStep = 3, kWidth = kCodes * kStep;
  const test::Scene ramp = FlatScene(kWidth, 24, 0, [](int x, int) { return x / kStep; });
  for (const starfocus_mode mode : test::kModes) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      for (const double blur : {0.0, 0.3, 1.0, 2.5, 5.0, 9.0, 14.0}) {
        const test::Refocused out =
            RefocusFlat(ramp, blur, mode, STARFOCUS_TRANSFER_SRGB, renderer);
        CAPTURES(mode, renderer, blur);
        bool monotone = true, survives = true;
        for (int y = 0; y < 24; ++y) {
          const auto at = [&](int x) { return int(out.rgb[size_t(3 * (y * kWidth + x))]); };
          for (int x = 1; x < kWidth; ++x) {
            monotone = monotone && at(x) >= at(x - 1) && at(x) - at(x - 1) <= 1;
          }
          // Blur must hardly change the ramp, except near the ends of the ramp.
          for (int x = 45; x < kWidth - 45; ++x) {
            survives = survives && std::abs(at(x) - x / kStep) <= 1;
          }
        }
        CHECK(monotone);
        CHECK(survives);
      }
    }
  }
}

TEST_CASE("transfer: a blurred black and white chequerboard has code 188, or 128 without a curve") {
  const test::Scene board =
      FlatScene(96, 96, 0, [](int x, int y) { return (x + y) % 2 == 0 ? 255 : 0; });
  for (const starfocus_mode mode : test::kModes) {
    for (const double blur : {6.0, 11.0, 20.0}) {
      // The line scan is excluded: its views are approximately a pixel apart and reproduce the
      // pattern of the chequerboard.
      const auto middle = [&](starfocus_transfer transfer) {
        const auto out = RefocusFlat(board, blur, mode, transfer, STARFOCUS_RENDERER_SLICES);
        return int(out.rgb[3 * (48 * 96 + 48)]);
      };
      CAPTURES(mode, blur);
      CHECK(std::abs(middle(STARFOCUS_TRANSFER_SRGB) - 188) <= 2);
      CHECK(std::abs(middle(STARFOCUS_TRANSFER_NONE) - 128) <= 2);
    }
  }
}

}  // namespace
}  // namespace transfer_test
