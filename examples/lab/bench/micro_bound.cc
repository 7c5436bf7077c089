// SPDX-License-Identifier: Apache-2.0
// Measures the time per pixel of the most expensive valid pictures, and of an ordinary picture.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "examples/lab/bench/micro.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/integer_scene.h"
#include "tests/support/test_scene.h"

namespace starfocus::bench {
namespace {

constexpr int kWidth = 384, kHeight = 256, kViews = 5;
constexpr int kBlur = 16;           // Largest blur radius, pixels.
constexpr double kHighlights = 16;  // Value of starfocus::Config.highlights.

struct Picture {
  const char* name;
  bool noisy_depth;  // True if the disparity of each pixel is random, from -kBlur to kBlur.
  int white;         // White squares in 1000 squares of 4x4 pixels; -1: the ordinary picture.
  double highlights;
};

constexpr Picture kPictures[] = {
    {"room", false, -1, 1},
    {"noisy_depth", true, 0, 1},
    {"noisy_depth_white_highlights", true, 1000, kHighlights},
    {"noisy_depth_lamps_highlights", true, 250, kHighlights},
    {"white_highlights", false, 1000, kHighlights},
};

test::Scene SceneOf(const Picture& picture) {
  if (picture.white < 0) {
    return test::IntegerScene(kWidth, kHeight, kViews, test::Depth::kRoom);
  }
  test::Scene scene = test::EmptyScene(kWidth, kHeight, kViews, -kBlur, kBlur);
  test::Random random(7);
  for (int view = 0; view < kViews; ++view) {
    for (int y = 0; y < kHeight; y += 4) {
      for (int x = 0; x < kWidth; x += 4) {
        const uint8_t code = random.Int(0, 999) < picture.white ? 255 : uint8_t(random.Int(0, 240));
        for (int row = y; row < y + 4; ++row) std::fill_n(scene.Pixel(view, x, row), 12, code);
      }
    }
  }
  for (float& disparity : scene.disparity) {
    disparity = picture.noisy_depth ? float(random.Real(-kBlur, kBlur)) : float(kBlur);
  }
  return scene;
}

void Refocus(const Picture& picture, benchmark::State& state) {
  const test::Scene scene = SceneOf(picture);
  test::Config config = test::ConfigFor(scene, kBlur);
  config.highlights = static_cast<float>(picture.highlights);
  test::Engine engine(config);
  test::Output out(kWidth, kHeight);
  const starfocus::Params params =
      test::Params(picture.white < 0 ? -1 : 0, 1, STARFOCUS_MODE_BLOCK);
  for (auto _ : state) {
    if (test::Refocus(&engine, params, scene, &out) != STARFOCUS_OK)
      state.SkipWithError("not refocused");
  }
  const double pixels = double(kWidth) * kHeight;
  state.counters["per_pixel"] = benchmark::Counter(
      pixels, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

void RegisterBounds() {
  for (const Picture& picture : kPictures) {
    benchmark::RegisterBenchmark((std::string("bound/") + picture.name).c_str(),
                                 [&picture](benchmark::State& state) { Refocus(picture, state); });
  }
}

}  // namespace starfocus::bench
