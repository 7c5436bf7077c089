// SPDX-License-Identifier: Apache-2.0
// Tests aperture 0: the result must be the centre view, byte for byte, in every mode and through
// every way to refocus.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace pinhole_test {
namespace {

// Returns a scene of random pictures; its map consists of flat areas and edges, or of noise.
test::Scene AnyScene(int width, int height, uint64_t seed) {
  const int views = test::kStars[seed % 4];
  if (seed % 3 == 0) return test::LayeredScene(width, height, views, 7, seed);
  test::Random random(seed);
  test::Scene scene = test::RandomScene(width, height, views, -7, 7, seed, int(seed % 5));
  if (seed % 3 == 1) test::NoisyDisparity(&scene, &random);
  return scene;
}

test::Config AnyConfig(const test::Scene& scene, test::Random* random) {
  test::Config config = test::ConfigFor(scene, 20);
  config.superblock = 32 << random->Int(0, 3);
  config.tuning.max_layer = random->Int(0, 2);
  config.tuning.deblocking = random->Int(0, 1) * 255;
  config.tuning.gather = random->Int(0, 1);
  config.tuning.n_scale = random->Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
  return config;
}

TEST_CASE("pinhole: every mode, renderer and way to refocus returns the centre view to the byte") {
  constexpr int kSizes[][2] = {{1, 1}, {3, 70}, {41, 31}, {64, 64}, {130, 67}, {97, 140}};
  test::Random random(51);
  uint64_t seed = 0;
  for (const auto& size : kSizes) {
    for (const starfocus_mode mode : test::kModes) {
      const test::Scene scene = AnyScene(size[0], size[1], ++seed);
      const test::Config config = AnyConfig(scene, &random);
      starfocus::Params params = test::Params(random.Real(-9, 9), 0, mode);
      params.study.renderer = random.Int(0, 2);
      params.theta = random.Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
      // At aperture 0, any focus is legal.
      if (seed % 4 == 0) params.focus = -STARFOCUS_MAX_FOCUS;
      CAPTURE(seed);
      const test::Output whole = test::CheckWays(scene, config, params);
      for (int y = 0; y < scene.height; ++y) {
        CHECK(std::equal(scene.Pixel(0, 0, y), scene.Pixel(0, 0, y) + 3 * scene.width,
                         whole.Pixel(0, y)));
      }
    }
  }
}

TEST_CASE("pinhole: the report counts one copied view, and bad maps are rejected") {
  test::Scene scene = test::LayeredScene(130, 67, 9, 7, 4);
  for (const starfocus_mode mode : test::kModes) {
    test::Report report;
    const starfocus::Params params =
        test::Params(-STARFOCUS_MAX_FOCUS, 0, mode, STARFOCUS_RENDERER_LINE_SCAN);
    const test::Output out = test::OutputOf(test::ConfigFor(scene, 20), params, scene, &report);
    CHECK(report.r_max == 0);
    CHECK(report.n == 0);
    CHECK(report.rendered_views == 1);
    CHECK(report.layers[0].pixels == 130 * 67);
    CHECK(report.layers[0].views == report.layers[0].blocks);
    CHECK(report.copied_pixels == 130 * 67);
  }
  test::Engine engine(test::ConfigFor(scene, 20));
  test::Output out(130, 67);
  scene.Disparity(129, 66) = 7.5f;
  CHECK(test::Refocus(&engine, test::Params(3, 0, STARFOCUS_MODE_BLOCK), scene, &out) ==
        STARFOCUS_ERROR_DISPARITY);
  CHECK(out.Untouched());
}

}  // namespace
}  // namespace pinhole_test
