// SPDX-License-Identifier: Apache-2.0
// Tests the lens of an engine. After a change of the lens, the bytes must equal the bytes from an
// engine that has used no other lens. The largest aperture is the largest that the engine accepts.
// At aperture 0, the picture is the centre view.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

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

// Returns the picture of a prepared light field.
test::Output OutputOfPrepared(const test::Engine& engine, const starfocus::Params& params,
                              const starfocus_prepared* prepared) {
  test::Output out(engine.config().width, engine.config().height);
  REQUIRE(test::RefocusPreparedRgb(engine.get(), &params, prepared, out.bytes.data(), out.stride,
                                   nullptr) == STARFOCUS_OK);
  return out;
}

TEST_CASE("lens: after a change of shape, an engine returns the bytes of a new engine") {
  const test::Scene scene = MakeScene();
  test::Engine engine(Config(scene)), other(Config(scene));
  test::PreparedMemory memory(other);
  const starfocus_prepared* const prepared = memory.Prepare(other.get(), scene.Field());
  for (const starfocus::Params& lens : Lenses()) {
    CAPTURE(test::ShapeText(lens));
    // The light field that another engine has prepared belongs to no lens.
    const starfocus::Params block = ParamsOf(lens, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_AUTO);
    CHECK((OutputOfPrepared(engine, block, prepared).bytes == Expected(scene, block)));
    // In the second iteration, the engine must use the tables that it made for this lens in the
    // same mode.
    std::vector<std::vector<uint8_t>> expected;
    for (const int round : {0, 1}) {
      size_t picture = 0;
      for (const starfocus_mode mode : test::kModes) {
        for (const starfocus_renderer renderer : test::kRenderers) {
          if (mode == STARFOCUS_MODE_BLUR && renderer == STARFOCUS_RENDERER_LINE_SCAN)
            continue;  // blur mode ignores the renderer
          CAPTURES(round, mode, renderer);
          const starfocus::Params params = ParamsOf(lens, mode, renderer);
          if (round == 0) expected.push_back(Expected(scene, params));
          CHECK((test::OutputOf(&engine, params, scene).bytes == expected[picture++]));
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

TEST_CASE("largest aperture: the engine accepts it and no larger one, for every max_blur") {
  double aperture = -77;
  for (const double max_blur :
       {5e-324, 1e-310, 2.2250738585072014e-308, 1e-300, 1e-9, 0.3, 7.0, 128.0}) {
    test::Config config;
    config.width = config.height = 16;
    config.views = 1;
    config.disparity_min = -3;
    config.disparity_max = 10;
    config.max_blur = max_blur;
    config.features |= STARFOCUS_FEATURE_STREAMING;
    const test::Engine engine(config);
    std::vector<double> planes = {-STARFOCUS_MAX_FOCUS, STARFOCUS_MAX_FOCUS};
    for (double focus = -20; focus <= 20; focus += 0.37) planes.push_back(focus);
    for (const double focus : planes) {
      CAPTURES(max_blur, focus);
      starfocus::Params params = test::Params(focus);
      REQUIRE(starfocus_largest_aperture(engine.get(), &params, &params.aperture) == STARFOCUS_OK);
      const double distance = std::max(10 - focus, focus + 3),
                   next = std::nextafter(params.aperture, 1);
      CHECK(params.aperture * distance <= max_blur);
      CHECK((params.aperture == 1 || next * distance > max_blur || next > max_blur / distance));
      CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
      if (params.aperture == 1 || max_blur < 1e-9) continue;
      params.aperture *= 1 + 1e-14;
      CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_ERROR_BLUR);
    }
    starfocus::Params params = test::Params(2 * STARFOCUS_MAX_FOCUS);
    CHECK(starfocus_largest_aperture(engine.get(), &params, &aperture) == STARFOCUS_ERROR_RANGE);
    CHECK(starfocus_engine_problem(engine.get())->field == std::string("focus"));
    CHECK(starfocus_largest_aperture(engine.get(), nullptr, &aperture) == STARFOCUS_ERROR_NULL);
    CHECK(starfocus_largest_aperture(engine.get(), &params, nullptr) == STARFOCUS_ERROR_NULL);
    CHECK(starfocus_largest_aperture(nullptr, &params, &aperture) == STARFOCUS_ERROR_NULL);
  }
  CHECK(aperture == -77);
}

TEST_CASE("pinhole: every mode, renderer and entry point returns the centre view to the byte") {
  constexpr int kSizes[][2] = {{1, 1}, {3, 70}, {41, 31}, {64, 64}, {130, 67}, {97, 140}};
  test::Random random(51);
  uint64_t seed = 0;
  for (const auto& size : kSizes) {
    for (const starfocus_mode mode : test::kModes) {
      CAPTURE(++seed);
      const int views = test::kStars[seed % 4];
      test::Scene scene = test::LayeredScene(size[0], size[1], views, 7, seed);
      if (seed % 3 == 1) test::NoisyDisparity(&scene, &random);
      test::Config config = test::ConfigFor(scene, 20);
      config.superblock = 32 << random.Int(0, 3);
      config.tuning.max_layer = random.Int(0, 2);
      config.tuning.deblocking = random.Int(0, 1) * 255;
      config.tuning.gather = random.Int(0, 1);
      config.tuning.n_scale = random.Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
      config.features |= STARFOCUS_FEATURE_STREAMING;
      starfocus::Params params = test::Params(random.Real(-9, 9), 0, mode);
      params.study.renderer = random.Int(0, 2);
      params.theta = random.Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
      // At aperture 0, any focus is legal.
      if (seed % 4 == 0) params.focus = -STARFOCUS_MAX_FOCUS;
      test::Output centre(size[0], size[1]), streamed = centre;
      for (int y = 0; y < size[1]; ++y) {
        std::copy_n(scene.Pixel(0, 0, y), 3 * size[0], &centre.bytes[size_t(y) * centre.stride]);
      }
      test::Engine engine(config);
      CHECK(test::OutputOf(&engine, params, scene).bytes == centre.bytes);
      REQUIRE(test::Stream(&engine, params, scene, &streamed, 7, 11) == STARFOCUS_OK);
      CHECK(streamed.bytes == centre.bytes);
      test::PreparedMemory memory(engine);
      const starfocus_prepared* const prepared = memory.Prepare(engine.get(), scene.Field());
      CHECK(OutputOfPrepared(engine, params, prepared).bytes == centre.bytes);
      params.region = {size[0] / 3, size[1] / 4, size[0] - size[0] / 3, (size[1] + 3) / 4};
      CHECK(test::IsPartOf(test::OutputOf(&engine, params, scene), centre, params.region));
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
}  // namespace lens_test
