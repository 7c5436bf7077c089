// SPDX-License-Identifier: Apache-2.0
// Tests changes of the lens between calls of one engine. The bytes must equal the bytes from an
// engine that has used no other lens.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/shapes.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace lens_test {
namespace {

constexpr int kWidth = 97, kHeight = 70;
constexpr test::NamedShape kPlain = {"fall-off", STARFOCUS_SHAPE_FALL_OFF, 5, 0, 0, 0.5F, 0};

starfocus::Params LensOf(const test::NamedShape& shape, double theta = 0.8) {
  starfocus::Params lens = test::Params(-3.5);
  lens.theta = theta;
  shape.Set(&lens);
  return lens;
}

// Returns lenses with openings of every shape. Some consecutive lenses differ in only one field.
std::vector<starfocus::Params> Lenses() {
  std::vector<starfocus::Params> lenses = {LensOf(kPlain)};
  for (const test::NamedShape& shape : test::kShapes) lenses.push_back(LensOf(shape));
  lenses.push_back(LensOf(kPlain));
  lenses.push_back(LensOf(kPlain, 1.2));
  const starfocus::Params polygon =
      LensOf({"hexagon", STARFOCUS_SHAPE_POLYGON, 6, 10, 0.25F, 0.5F, 0});
  lenses.insert(lenses.end(), 8, polygon);
  lenses[lenses.size() - 7].blades = 7;
  lenses[lenses.size() - 5].rotation = 30;
  lenses[lenses.size() - 3].curvature = 0.75;
  lenses[lenses.size() - 1].cats_eye = 0.75;
  const starfocus::Params ring = LensOf({"ring", STARFOCUS_SHAPE_RING, 5, 0, 0, 0.25F, 0});
  lenses.insert(lenses.end(), 2, ring);
  lenses.back().ring_inner = 0.75;
  lenses.push_back(LensOf(kPlain));
  return lenses;
}

test::Scene MakeScene() { return test::LayeredScene(kWidth, kHeight, 5, 4, 3); }

test::Config Config(const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene, 10);
  config.superblock = 32;
  config.features |= STARFOCUS_FEATURE_SHAPES | STARFOCUS_FEATURE_STREAMING;
  return config;
}

starfocus::Params ParamsOf(const starfocus::Params& lens, starfocus_mode mode,
                           starfocus_renderer renderer) {
  starfocus::Params params = lens;
  params.study.mode = mode;
  params.study.renderer = renderer;
  return params;
}

// Refocuses a scene with an engine that has memory for a single aperture shape, and returns the
// picture.
std::vector<uint8_t> Expected(const test::Scene& scene, const starfocus::Params& params) {
  test::Config config = Config(scene);
  test::ReserveFor(params, &config);
  const test::Output out = test::OutputOf(config, params, scene);
  return out.bytes;
}

TEST_CASE("lens: after a change of shape, an engine returns the bytes of a new engine") {
  const test::Scene scene = MakeScene();
  test::Engine engine(Config(scene));
  int index = 0;
  for (const starfocus::Params& lens : Lenses()) {
    CAPTURE(index);
    ++index;
    // In the second iteration, the engine must use the tables that it made for this lens in the
    // same mode.
    for (const int round : {0, 1}) {
      for (const starfocus_mode mode : test::kModes) {
        for (const starfocus_renderer renderer : test::kRenderers) {
          if (mode == STARFOCUS_MODE_BLUR && renderer == STARFOCUS_RENDERER_LINE_SCAN)
            continue;  // blur mode ignores the renderer
          CAPTURES(round, mode, renderer);
          const starfocus::Params params = ParamsOf(lens, mode, renderer);
          const test::Output out = test::OutputOf(&engine, params, scene);
          CHECK((out.bytes == Expected(scene, params)));
        }
      }
    }
  }
}

// Progress callback that cancels the refocusing after `left` further calls.
int CancelAfter(void* left, int32_t, int32_t) { return (*static_cast<int*>(left))-- == 0; }

TEST_CASE("lens: a call with another shape does not use the tables of a cancelled call") {
  const test::Scene scene = MakeScene();
  const starfocus::Params pentagon = LensOf(test::kShapes[1]), plain = LensOf(kPlain);
  for (const starfocus_mode mode : test::kModes) {
    CAPTURE(mode);
    test::Engine engine(Config(scene));
    const auto check = [&](const starfocus::Params& lens) {
      const starfocus::Params params = ParamsOf(lens, mode, STARFOCUS_RENDERER_AUTO);
      const test::Output out = test::OutputOf(&engine, params, scene);
      CHECK((out.bytes == Expected(scene, params)));
    };
    int cancelled = 0;
    for (int calls = 0; calls < 6; ++calls) {
      int left = calls;
      test::Output out(kWidth, kHeight);
      const starfocus::Params params = ParamsOf(pentagon, mode, STARFOCUS_RENDERER_AUTO);
      const starfocus_status status =
          test::Refocus(&engine, params, scene, &out, test::ToldTo(CancelAfter, &left));
      cancelled += status == STARFOCUS_ERROR_CANCELLED;
      check(calls % 2 == 0 ? plain : pentagon);
    }
    CHECK(cancelled > 1);
  }
}

TEST_CASE("lens: engines share a prepared light field, each with different lenses") {
  const test::Scene scene = MakeScene();
  const test::Config config = Config(scene);
  test::Engine first(config), second(config);
  size_t bytes = 0;
  REQUIRE(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  std::vector<uint8_t> memory(bytes + STARFOCUS_ALIGNMENT);
  uint8_t* const aligned = memory.data() + STARFOCUS_ALIGNMENT -
                           reinterpret_cast<uintptr_t>(memory.data()) % STARFOCUS_ALIGNMENT;
  const starfocus_light_field field = scene.Field();
  starfocus_prepared* prepared = nullptr;
  REQUIRE(starfocus_prepare(first.get(), &field, aligned, bytes, &prepared) == STARFOCUS_OK);
  const std::vector<starfocus::Params> lenses = Lenses();
  for (size_t k = 0; k < lenses.size(); ++k) {
    CAPTURE(k);
    for (const bool ahead : {false, true}) {
      const starfocus::Params& lens = lenses[(k + (ahead ? 1 : 0)) % lenses.size()];
      const starfocus::Params params =
          ParamsOf(lens, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO);
      test::Output out(kWidth, kHeight);
      REQUIRE(test::RefocusPreparedRgb((ahead ? second : first).get(), &params, prepared,
                                       out.bytes.data(), out.stride, nullptr) == STARFOCUS_OK);
      CHECK((out.bytes == Expected(scene, params)));
    }
  }
}

TEST_CASE("lens: a stream keeps the lens that was given to begin") {
  const test::Scene scene = MakeScene();
  test::Engine engine(Config(scene));
  for (const starfocus::Params& lens : Lenses()) {
    const starfocus::Params expected =
        ParamsOf(lens, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO);
    starfocus::Params params = expected;
    REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
    params = LensOf(test::kShapes[0]);
    // A rejected starfocus_stream_begin changes nothing.
    params.blades = 99;
    CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_ERROR_RANGE);
    test::Output out(kWidth, kHeight);
    test::StreamSteps steps = {&engine, scene, &out};
    while (!steps.Ended()) REQUIRE(steps.Step() == STARFOCUS_OK);
    CHECK((out.bytes == Expected(scene, expected)));
  }
}

TEST_CASE("lens: the missing fields of a shorter starfocus_params get their defaults") {
  constexpr uint32_t kShort = offsetof(starfocus_params, theta);
  const test::Scene scene = MakeScene();
  const starfocus::Params expected = test::Params(-3.5, 1, STARFOCUS_MODE_BLOCK);
  std::vector<uint8_t> memory(kShort);
  starfocus_params* const params = reinterpret_cast<starfocus_params*>(memory.data());
  starfocus_defaults("starfocus_params", params, kShort);
  CHECK(params->size == kShort);
  params->focus = expected.focus;
  test::Engine engine(Config(scene));
  test::Output out(kWidth, kHeight);
  const starfocus_light_field field = scene.Field();
  REQUIRE(test::RefocusRgb(engine.get(), params, &field, out.bytes.data(), out.stride, nullptr) ==
          STARFOCUS_OK);
  CHECK((out.bytes == Expected(scene, expected)));
}

TEST_CASE("lens: without STARFOCUS_FEATURE_SHAPES, only polygons and cat's eyes are rejected") {
  const test::Scene scene = MakeScene();
  test::Config config = Config(scene);
  config.features &= ~STARFOCUS_FEATURE_SHAPES;
  test::Engine engine(config);
  for (const starfocus::Params& lens : Lenses()) {
    const bool refused = lens.shape == STARFOCUS_SHAPE_POLYGON || lens.cats_eye > 0;
    const starfocus::Params params = ParamsOf(lens, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO);
    test::Output out(kWidth, kHeight);
    const starfocus_status status = test::Refocus(&engine, params, scene, &out);
    CHECK(status == (refused ? STARFOCUS_ERROR_FEATURE : STARFOCUS_OK));
    CHECK(out.Untouched() == refused);
  }
}

TEST_CASE(
    "lens: only with STARFOCUS_FEATURE_SHAPES, the workspace has memory for polygons and cat's "
    "eyes") {
  for (const int block : {32, 64, 128}) {
    for (const double blur : {0.5, 8.0, 32.0, 128.0}) {
      test::Config config;
      config.width = config.height = 500;
      config.superblock = block;
      config.max_blur = blur;
      size_t without = 0, with = 0;
      REQUIRE(starfocus_workspace_size(&config, &without, nullptr) == STARFOCUS_OK);
      config.features |= STARFOCUS_FEATURE_SHAPES;
      REQUIRE(starfocus_workspace_size(&config, &with, nullptr) == STARFOCUS_OK);
      CAPTURES(block, blur);
      CHECK(with > without);
    }
  }
}

}  // namespace
}  // namespace lens_test

// Tests aperture 0: the result must be the centre view, byte for byte, in every mode and through
// every way to refocus.

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
