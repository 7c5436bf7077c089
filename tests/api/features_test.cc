// SPDX-License-Identifier: Apache-2.0
// Tests starfocus_config.features. Without starfocus_tuning.line_scan, an engine must return
// unchanged pictures with slices, reject the renderer line-scan, and require less memory.
#include <doctest/doctest.h>

#include <cstdint>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace features_test {
namespace {

test::Config WithoutLineScan(test::Config config) {
  config.tuning.line_scan = nullptr;
  return config;
}

TEST_CASE("features: without line-scan, the default renderer is slices") {
  for (const int views : {1, 5, 17}) {
    const test::Scene scene = test::RandomScene(150, 90, views, -6, 6, uint64_t(views));
    const test::Config config = test::ConfigFor(scene, 16);
    test::Engine with(config), without(WithoutLineScan(config));
    for (const starfocus_mode mode : test::kModes) {
      for (const starfocus_renderer renderer :
           {STARFOCUS_RENDERER_AUTO, STARFOCUS_RENDERER_SLICES}) {
        CAPTURES(views, mode, renderer);
        starfocus::Params params = test::Params(2, 1, mode, renderer);
        test::Report report, expected_report;
        const test::Output out = test::OutputOf(&without, params, scene, &report);
        params.study.renderer = STARFOCUS_RENDERER_SLICES;
        const test::Output expected = test::OutputOf(&with, params, scene, &expected_report);
        CHECK(out.bytes == expected.bytes);
        CHECK(report.n == expected_report.n);
        CHECK(report.rendered_samples == expected_report.rendered_samples);
      }
    }
  }
}

TEST_CASE("features: without line-scan, all modes except blur reject the renderer line-scan") {
  const test::Scene scene = test::RandomScene(70, 50, 5, -4, 4, 1);
  test::Config config = WithoutLineScan(test::ConfigFor(scene, 16));
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  for (const starfocus_mode mode : test::kModes) {
    CAPTURE(mode);
    starfocus::Params params = test::Params(1, 1, mode, STARFOCUS_RENDERER_LINE_SCAN);
    const starfocus_status expected =
        mode == STARFOCUS_MODE_BLUR ? STARFOCUS_OK : STARFOCUS_ERROR_FEATURE;
    test::Output out(70, 50);
    CHECK(test::Refocus(&engine, params, scene, &out) == expected);
    CHECK(out.Untouched() == (mode != STARFOCUS_MODE_BLUR));
    CHECK(starfocus_stream_begin(engine.get(), &params) == expected);
  }
}

TEST_CASE("features: a workspace without the line scan is smaller") {
  for (const int block : {32, 64, 128, 256}) {
    for (const double blur : {0.5, 8.0, 32.0, 128.0}) {
      for (const bool shapes : {false, true}) {
        test::Config config;
        config.width = config.height = 500;
        config.superblock = block;
        config.max_blur = blur;
        test::SetFeature(STARFOCUS_FEATURE_SHAPES, shapes, &config.features);
        const test::Config less = WithoutLineScan(config);
        size_t with = 0, without = 0;
        REQUIRE(starfocus_workspace_size(&config, &with, nullptr) == STARFOCUS_OK);
        REQUIRE(starfocus_workspace_size(&less, &without, nullptr) == STARFOCUS_OK);
        CAPTURES(block, blur);
        CHECK(without < with);
      }
    }
  }
}

}  // namespace
}  // namespace features_test
