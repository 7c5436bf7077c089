// SPDX-License-Identifier: Apache-2.0
// sf_config.features: an engine without the line scan renders the same pictures by slices, rejects
// the paper's rule and is smaller.
#include <doctest/doctest.h>

#include <cstdint>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace features_test {
namespace {

sf_config WithoutLineScan(sf_config config) {
  config.features &= ~SF_FEATURE_LINE_SCAN;
  return config;
}

constexpr sf_mode kModes[] = {SF_MODE_FRAME, SF_MODE_BENCHMARK, SF_MODE_BLOCK, SF_MODE_BLUR};

TEST_CASE("features: without the line scan the default and slices give the bytes of slices") {
  for (const int views : {1, 5, 17}) {
    const test::Scene scene = test::RandomScene(150, 90, views, -6, 6, uint64_t(views));
    const sf_config config = test::ConfigFor(scene, 16);
    test::Engine with(config), without(WithoutLineScan(config));
    for (const sf_mode mode : kModes) {
      for (const sf_renderer renderer : {SF_RENDERER_AUTO, SF_RENDERER_SLICES}) {
        CAPTURE(views);
        CAPTURE(mode);
        CAPTURE(renderer);
        sf_params params = test::Params(2, 1, mode);
        params.renderer = renderer;
        test::Output out(150, 90), expected(150, 90);
        sf_report report, expected_report;
        REQUIRE(test::Refocus(&without, params, scene, &out, nullptr, nullptr, &report) == SF_OK);
        params.renderer = SF_RENDERER_SLICES;
        REQUIRE(test::Refocus(&with, params, scene, &expected, nullptr, nullptr,
                              &expected_report) == SF_OK);
        CHECK(out.bytes == expected.bytes);
        CHECK(report.n == expected_report.n);
        CHECK(report.rendered_samples == expected_report.rendered_samples);
      }
    }
  }
}

TEST_CASE("features: without the line scan the paper's rule is rejected in modes that render") {
  const test::Scene scene = test::RandomScene(70, 50, 5, -4, 4, 1);
  sf_config config = WithoutLineScan(test::ConfigFor(scene, 16));
  config.features |= SF_FEATURE_STREAMING;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  for (const sf_mode mode : kModes) {
    CAPTURE(mode);
    sf_params params = test::Params(1, 1, mode);
    params.renderer = SF_RENDERER_LINE_SCAN;
    const sf_status expected = mode == SF_MODE_BLUR ? SF_OK : SF_ERROR_FEATURE;
    test::Output out(70, 50);
    CHECK(test::Refocus(&engine, params, scene, &out) == expected);
    CHECK(out.Untouched() == (mode != SF_MODE_BLUR));
    CHECK(sf_stream_begin(engine.get(), &params) == expected);
  }
}

TEST_CASE("features: a workspace without the line scan is smaller") {
  for (const int block : {32, 64, 128, 256}) {
    for (const double blur : {0.5, 8.0, 32.0, 128.0}) {
      for (const bool shapes : {false, true}) {
        sf_config config;
        sf_config_init(&config);
        config.width = config.height = 500;
        config.superblock = block;
        config.max_blur = blur;
        test::SetFeature(SF_FEATURE_SHAPES, shapes, &config.features);
        const sf_config less = WithoutLineScan(config);
        size_t with = 0, without = 0;
        REQUIRE(sf_workspace_size(&config, &with) == SF_OK);
        REQUIRE(sf_workspace_size(&less, &without) == SF_OK);
        CAPTURE(block);
        CAPTURE(blur);
        CHECK(without < with);
      }
    }
  }
}

}  // namespace
}  // namespace features_test
