// SPDX-License-Identifier: Apache-2.0
// Tests starfocus_tuning.n_scale through the public ABI: the resulting N, the modes that ignore it,
// and the trade-off between time and error.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/optics/rules.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/integer_scene.h"
#include "tests/support/psnr.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace n_scale_test {
namespace {

using test::Refocused;

constexpr double kScales[] = {0.5, 0.7, 1, 1.4, 2};

Refocused Refocus(const test::Scene& scene, const starfocus::Params& params, double n_scale,
                  double max_blur = 32) {
  test::Config config = test::ConfigFor(scene, max_blur);
  config.tuning.n_scale = n_scale;
  config.tuning.gather = 0;  // If all cells are rendered from views, only N affects the pictures.
  return test::RefocusScene(scene, config, params);
}

test::Scene FlatScene(uint64_t seed) { return test::RandomScene(40, 36, 5, 0, 0, seed); }

TEST_CASE("n_scale: the scale multiplies N of both renderers in frame and block mode") {
  const test::Scene scene = FlatScene(1);
  for (const double radius : {0.0, 0.25, 0.9, 3.5, 9.0, 17.0, 25.0}) {
    for (const double scale : kScales) {
      for (const starfocus_renderer renderer : test::kRenderers) {
        for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
          starfocus::Params params = test::Params(radius, 1, mode, renderer);
          test::Config config = test::ConfigFor(scene);
          config.tuning.n_scale = scale;
          config.tuning.max_layer = 0;
          config.tuning.gather = 0;  // All cells are rendered from views.
          starfocus_report report = starfocus::NewReport();
          const test::Output out = test::OutputOf(config, params, scene, &report);
          const int n = renderer == STARFOCUS_RENDERER_LINE_SCAN
                            ? starfocus::ViewsByPaper(radius)
                            : starfocus::ViewsBySubaperture(radius);
          CAPTURES(radius, scale, mode);
          CHECK(report.n == int(std::ceil(n * scale - 1e-9)));
        }
      }
    }
  }
}

TEST_CASE("n_scale: the scale does not affect benchmark and blur mode") {
  const test::Scene scene = test::IntegerScene(70, 50, 5, test::Depth::kLayers);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLUR}) {
    const starfocus::Params params = test::Params(1, 0.5, mode);
    const Refocused plain = Refocus(scene, params, 1);
    for (const double scale : kScales) {
      const Refocused scaled = Refocus(scene, params, scale);
      CHECK((scaled.rgb == plain.rgb));
      if (mode == STARFOCUS_MODE_BENCHMARK) CHECK(scaled.report.n == plain.report.n);
    }
  }
}

TEST_CASE(
    "n_scale: with scale 2, the smallest workspace and a large workspace give equal pictures") {
  for (const double radius : {0.3, 0.51, 1.0, 2.5}) {
    const test::Scene scene = FlatScene(2);
    for (const starfocus_renderer renderer : test::kRenderers) {
      for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
        starfocus::Params params = test::Params(radius, 1, mode, renderer);
        CAPTURE(radius);
        CHECK((Refocus(scene, params, 2, radius).rgb == Refocus(scene, params, 2, 64).rgb));
      }
    }
  }
}

TEST_CASE(
    "n_scale: a larger scale renders more views, and the picture is closer to the benchmark") {
  // The scene has only one view: noise that side views show beyond the picture would differ between
  // layers.
  const test::Scene scene = test::IntegerScene(160, 120, 1, test::Depth::kSlanted);
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
    starfocus::Params params = test::Params(-9.5, 1, STARFOCUS_MODE_BENCHMARK);
    const std::vector<uint8_t> benchmark = Refocus(scene, params, 1).rgb;
    params.study.mode = mode;
    std::string line = "mode " + std::to_string(mode) + ":";
    uint64_t samples = 0;
    std::vector<double> psnr;
    for (const double scale : kScales) {
      const Refocused picture = Refocus(scene, params, scale);
      CAPTURES(mode, scale);
      CHECK(picture.report.rendered_samples > samples);
      samples = picture.report.rendered_samples;
      psnr.push_back(test::Psnr(picture.rgb, benchmark));
      line += " " + std::to_string(samples) + " samples, " + std::to_string(psnr.back()) + " dB;";
    }
    MESSAGE(line);
    CHECK(psnr.front() + 1 < psnr[2]);
    CHECK(psnr[2] <= psnr.back());
  }
}

}  // namespace
}  // namespace n_scale_test
