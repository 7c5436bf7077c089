// SPDX-License-Identifier: Apache-2.0
// Tests views at any positions through the C ABI.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace views_test {
namespace {

constexpr double kFocus = 2;

test::Scene Scene(const std::vector<starfocus_position>& positions) {
  test::Scene scene = test::RandomScene(70, 50, int(positions.size()), -4, 6, 11);
  scene.positions = positions;
  return scene;
}

std::vector<uint8_t> Picture(const test::Scene& scene, starfocus_mode mode = STARFOCUS_MODE_BLOCK,
                             starfocus_renderer renderer = STARFOCUS_RENDERER_SLICES) {
  starfocus::Params params = test::Params(kFocus, 1, mode, renderer);
  return test::RefocusScene(scene, test::ConfigFor(scene), params).rgb;
}

TEST_CASE(
    "views: explicit views at star positions give the result of a star set, with subapertures in "
    "any order") {
  for (const int views : {5, 9, 17}) {
    test::Scene scene = test::RandomScene(70, 50, views, -4, 6, 5);
    const std::vector<uint8_t> block = Picture(scene);
    const std::vector<uint8_t> paper =
        Picture(scene, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN);
    std::vector<starfocus_position> positions;
    for (int k = 0; k < views; ++k) positions.push_back(scene.PositionOf(k));
    scene.positions = positions;
    CHECK(Picture(scene) == block);
    CHECK(Picture(scene, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN) == paper);
    CHECK(Picture(scene, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_AUTO) == paper);
    for (const int other : {2, 4, 3}) {
      std::swap(scene.positions[1], scene.positions[size_t(other)]);
      std::swap(scene.pictures[1], scene.pictures[size_t(other)]);
    }
    CHECK(Picture(scene) == block);
  }
}

// The line scan would draw a halo as wide as the blur around silhouettes in a light field of one
// view.
TEST_CASE(
    "views: with one view, the renderer slices is used in every mode unless line-scan is "
    "requested") {
  const test::Scene scene = test::RandomScene(70, 50, 1, -4, 6, 5);
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLOCK}) {
    CHECK(Picture(scene, mode, STARFOCUS_RENDERER_AUTO) ==
          Picture(scene, mode, STARFOCUS_RENDERER_SLICES));
    CHECK(Picture(scene, mode, STARFOCUS_RENDERER_LINE_SCAN) !=
          Picture(scene, mode, STARFOCUS_RENDERER_SLICES));
  }
  const test::Scene star = test::RandomScene(70, 50, 5, -4, 6, 5);
  CHECK(Picture(star, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_AUTO) ==
        Picture(star, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN));
}

TEST_CASE("views: the second view of a pair and its position affect the picture") {
  const test::Scene pair = Scene({{0, 0}, {1, 0}});
  test::Scene one = pair;
  one.pictures.resize(1);
  one.positions.resize(1);
  CHECK(Picture(pair) != Picture(one));
  test::Scene other = pair;
  other.positions[1] = {1, 0.01};
  CHECK(Picture(pair) != Picture(other));
}

TEST_CASE(
    "views: a mirrored scene, with the side view at the mirrored position, gives the mirrored "
    "picture") {
  const test::Scene scene = Scene({{0, 0}, {0.7, 0}});
  test::Scene mirrored = scene;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      mirrored.Disparity(scene.width - 1 - x, y) = scene.Disparity(x, y);
      for (int view = 0; view < scene.views(); ++view) {
        std::copy_n(scene.Pixel(view, x, y), 3, mirrored.Pixel(view, scene.width - 1 - x, y));
      }
    }
  }
  const auto mean = [&] {
    const auto a = Picture(scene, STARFOCUS_MODE_FRAME),
               b = Picture(mirrored, STARFOCUS_MODE_FRAME);
    const int width = scene.width;
    double sum = 0;
    for (int i = 0; i < 3 * width * scene.height; ++i) {
      const int x = i / 3 % width, there = i + 3 * (width - 1 - 2 * x);
      sum += std::abs(a[size_t(i)] - b[size_t(there)]);
    }
    return sum / double(a.size());
  };
  const double other_side = mean();
  mirrored.positions[1].u = -0.7;
  // The slices of noisy scenes may differ.
  CHECK(3 * mean() < other_side);
  CHECK(other_side > 1);
}

TEST_CASE("views: the renderer line-scan requires a star set, and the renderer slices does not") {
  const test::Scene scene = Scene({{0, 0}, {1, 0}, {0, 1}});
  test::Config config = test::ConfigFor(scene);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  test::Output out(scene.width, scene.height);
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK, STARFOCUS_MODE_BLOCK}) {
    starfocus::Params params = test::Params(kFocus, 0.5, mode, STARFOCUS_RENDERER_LINE_SCAN);
    CHECK(test::Refocus(&engine, params, scene, &out) == STARFOCUS_ERROR_FEATURE);
    CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_ERROR_FEATURE);
    params.study.renderer = STARFOCUS_RENDERER_AUTO;
    REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
    const std::vector<uint8_t> by_default = out.Tight();
    params.study.renderer = STARFOCUS_RENDERER_SLICES;
    REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
    CHECK(out.Tight() == by_default);
  }
  starfocus::Params blur = test::Params(kFocus, 0.5, STARFOCUS_MODE_BLUR);
  blur.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;  // blur mode ignores the renderer
  CHECK(test::Refocus(&engine, blur, scene, &out) == STARFOCUS_OK);
}

TEST_CASE("views: starfocus_workspace_size rejects bad positions") {
  const test::Scene scene = Scene({{0, 0}, {1, 0}});
  const auto status = [&](const std::vector<starfocus_position>& positions) {
    test::Config config = test::ConfigFor(scene);
    std::copy(positions.begin(), positions.end(), config.positions);
    size_t bytes = 0;
    return starfocus_workspace_size(&config, &bytes, nullptr);
  };
  CHECK(status({{0, 0}, {-1, 1}}) == STARFOCUS_OK);
  // Without positions, a light field of two views is illegal, since no star set has two views.
  CHECK(status({{0, 0}, {0, 0}}) == STARFOCUS_ERROR_RANGE);
  CHECK(status({{0, 0}, {1.5, 0}}) == STARFOCUS_ERROR_RANGE);
  CHECK(status({{0.5, 0}, {1, 0}}) == STARFOCUS_ERROR_RANGE);
}

}  // namespace
}  // namespace views_test

// Tests starfocus_config.features. Without starfocus_tuning.line_scan, an engine must return
// unchanged pictures with slices, reject the renderer line-scan, and require less memory.

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
