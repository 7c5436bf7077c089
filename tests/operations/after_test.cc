// SPDX-License-Identifier: Apache-2.0
// Tests starfocus_params.previous: a previous frame must not change the bytes of the refocused
// frame, and unchanged blocks must be reused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace after_test {
namespace {

starfocus_status After(test::Engine* engine, const starfocus::Params& params,
                       const test::Scene& scene, const test::Scene& before,
                       const test::Output& before_out, test::Output* out,
                       starfocus_report* report) {
  const starfocus_light_field field = scene.Field();
  const starfocus_light_field before_field = before.Field();
  const starfocus_image before_image =
      starfocus_image_rgb(before_out.bytes.data(), before_out.stride);
  const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
  return test::RefocusAfterRgb(engine->get(), &params, &field, &previous, out->bytes.data(),
                               out->stride, report);
}

int Superblocks(const test::Scene& scene, int side) {
  return ((scene.width + side - 1) / side) * ((scene.height + side - 1) / side);
}

// Changes a random pixel or square of one view or of the disparity map. If `unknown` is true, new
// disparities may be NaN.
void Change(test::Scene* scene, bool unknown, test::Random* random) {
  const int x0 = random->Int(0, scene->width - 1), y0 = random->Int(0, scene->height - 1);
  const int side = random->Int(0, 1) * random->Int(0, 12);
  const int view = random->Int(-1, scene->views() - 1);
  const bool forget = unknown && random->Int(0, 1) == 0;
  const float d = forget ? std::numeric_limits<float>::quiet_NaN()
                         : float(random->Real(scene->disparity_min, scene->disparity_max));
  for (int y = y0; y <= std::min(y0 + side, scene->height - 1); ++y) {
    for (int x = x0; x <= std::min(x0 + side, scene->width - 1); ++x) {
      if (view < 0) {
        scene->Disparity(x, y) = d;
      } else {
        for (int c = 0; c < 3; ++c) scene->Pixel(view, x, y)[c] = random->Byte();
      }
    }
  }
}

void CheckFrames(test::Scene scene, const test::Config& config, const starfocus::Params& params,
                 int frames, test::Random* random) {
  test::Engine engine(config), alone(config);
  const starfocus_region& r = params.region;
  const int width = r.width > 0 ? r.width : scene.width;
  const int height = r.height > 0 ? r.height : scene.height;
  test::Output before_out(width, height, 2);
  REQUIRE(test::Refocus(&engine, params, scene, &before_out) == STARFOCUS_OK);
  for (int frame = 0; frame < frames; ++frame) {
    CAPTURE(frame);
    const test::Scene before = scene;
    const int changes = random->Int(0, 3);
    for (int k = 0; k < changes; ++k)
      Change(&scene, config.unknown == STARFOCUS_UNKNOWN_FILL, random);
    test::Output expected(width, height, 2), out(width, height, 2);
    test::Report report, whole;
    REQUIRE(After(&engine, params, scene, before, before_out, &out, &report) == STARFOCUS_OK);
    REQUIRE(test::Refocus(&alone, params, scene, &expected, nullptr, nullptr, &whole) ==
            STARFOCUS_OK);
    CHECK((out.bytes == expected.bytes));
    CHECK(whole.reused_blocks == 0);
    if (r.width == 0) {
      const int blocks = Superblocks(scene, config.superblock);
      CHECK(report.reused_blocks <= uint64_t(blocks));
      if (changes == 0) CHECK(report.reused_blocks == uint64_t(blocks));
      if (report.reused_blocks == uint64_t(blocks)) CHECK(report.rendered_samples == 0);
    }
    before_out = out;
  }
}

TEST_CASE("previous frame: reusing blocks does not change the bytes of a frame in any mode") {
  test::Random random(91);
  for (int round = 0; round < test::Rounds(32); ++round) {
    CAPTURE(round);
    const int width = random.Int(1, 300), height = random.Int(1, 260);
    const test::Scene scene =
        test::LayeredScene(width, height, test::kStars[round % 4], 5, uint64_t(round) + 900);
    test::Config config = test::ConfigFor(scene, 12);
    config.superblock = 32 << random.Int(0, 1);
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    config.tuning.deblocking = random.Int(0, 3) == 0 ? 35 : 255;
    starfocus::Params params =
        test::Params(random.Real(-5, 5), random.Real(0.1, 1), STARFOCUS_MODE_BLOCK);
    params.study.renderer = random.Int(0, 2);
    if (round % 4 == 3)
      params.study.mode = round % 8 == 3 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLUR;
    if (round % 5 == 4) {
      params.region = {random.Int(0, width - 1), random.Int(0, height - 1), 1, 1};
      params.region.width = random.Int(1, width - params.region.x);
      params.region.height = random.Int(1, height - params.region.y);
    }
    CheckFrames(scene, config, params, 6, &random);
  }
}

TEST_CASE(
    "previous frame: filled disparities are updated if known disparities next to the gap change") {
  test::Random random(93);
  for (int round = 0; round < test::Rounds(16); ++round) {
    CAPTURE(round);
    const int width = random.Int(100, 500), height = random.Int(40, 120);
    test::Scene scene =
        test::RandomScene(width, height, round % 2 == 0 ? 1 : 5, -3, 3, 40 + uint64_t(round));
    for (int y = 0; y < height; ++y) {
      const int first = random.Int(0, width - 1), last = random.Int(first, width - 1);
      for (int x = first; x <= last; ++x)
        scene.Disparity(x, y) = std::numeric_limits<float>::infinity();
    }
    test::Config config = test::ConfigFor(scene, 8);
    config.superblock = 32;
    config.unknown = STARFOCUS_UNKNOWN_FILL;
    CheckFrames(scene, config, test::Params(random.Real(-3, 3), 0.5, STARFOCUS_MODE_BLOCK), 8,
                &random);
  }
}

TEST_CASE(
    "previous frame: a change of a side view reaches blocks up to the largest disparity away") {
  const test::Scene before = test::NearScene(70, 900, 5, 13);
  test::Config config = test::ConfigFor(before, 8);
  config.superblock = 32;
  test::Engine engine(config);
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
    const starfocus::Params params = test::Params(test::kNearFocus, 0.2, mode);
    const test::Output first = test::OutputOf(&engine, params, before);
    for (int view = 1; view < 5; ++view) {
      CAPTURE(view);
      test::Scene scene = before;
      for (int x = 0; x < 70; ++x) {
        for (int y = 445; y < 455; ++y) scene.Pixel(view, x, y)[1] ^= 0xFF;
      }
      test::Output second(70, 900);
      test::Report report;
      REQUIRE(After(&engine, params, scene, before, first, &second, &report) == STARFOCUS_OK);
      const test::Output expected = test::OutputOf(&engine, params, scene);
      CHECK((second.bytes == expected.bytes));
      CHECK((expected.bytes != first.bytes));
      CHECK(report.reused_blocks > 0);
    }
  }
}

TEST_CASE(
    "previous frame: boundaries between blocks of different layers are deblocked near a change") {
  test::Random random(92);
  test::Scene scene = test::LayeredScene(320, 320, 1, 6, 5);
  test::SetDisparity(&scene,
                     [&](int x, int y) { return (x / 32 + y / 32) % 2 == 0 ? 0.0f : 6.0f; });
  test::Config config = test::ConfigFor(scene, 9);
  config.superblock = 32;
  config.tuning.deblocking = 255;
  for (const double focus : {-1.0, 0.0, 3.0}) {
    starfocus::Params params =
        test::Params(focus, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
    CheckFrames(scene, config, params, 12, &random);
  }
}

TEST_CASE("previous frame: if the layer of a block changes, its boundaries are deblocked again") {
  // With the timing model of this test, the engine divides no superblock into smaller blocks. A
  // single pixel in focus is enough to keep a block at layer 0.
  test::Scene scene = test::LayeredScene(600, 600, 1, 6, 5);
  std::fill(scene.disparity.begin(), scene.disparity.end(), 6.0f);
  scene.Disparity(500, 5) = scene.Disparity(5, 500) = 0;
  test::Config config = test::ConfigFor(scene, 6);
  config.superblock = 256;
  config.tuning.deblocking = 255;
  config.tuning.timing = {};
  config.tuning.timing.block = STARFOCUS_MAX_TIMING;
  starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
  test::Engine engine(config);
  test::Output second(600, 600);
  test::Report report;
  const test::Output first = test::OutputOf(&engine, params, scene);
  const test::Scene before = scene;
  scene.Disparity(5, 5) = 0;
  REQUIRE(After(&engine, params, scene, before, first, &second, &report) == STARFOCUS_OK);
  const test::Output expected = test::OutputOf(&engine, params, scene);
  CHECK((second.bytes == expected.bytes));
  CHECK(report.reused_blocks == 5);  // The engine reuses all 9 blocks except the upper left 4.
  // Deblocking must change pixels to the right of the changed block and below it.
  bool right = false, below = false;
  for (int k = 20; k < 200; ++k) {
    right = right || !std::equal(second.Pixel(256, k), second.Pixel(257, k), first.Pixel(256, k));
    below =
        below || !std::equal(second.Pixel(k, 256), second.Pixel(k + 1, 256), first.Pixel(k, 256));
  }
  CHECK(right);
  CHECK(below);
}

TEST_CASE("previous frame: blocks far from a change are reused") {
  const test::Scene before = test::LayeredScene(640, 512, 5, 2, 6);
  test::Config config = test::ConfigFor(before, 4);
  // The search for coverage would read pixels farther away from the change.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  test::Engine engine(config);
  const starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK);
  test::Output second(640, 512);
  test::Report whole, report;
  const test::Output first = test::OutputOf(&engine, params, before, &whole);
  test::Scene now = before;
  now.Pixel(3, 40, 30)[1] ^= 1;
  REQUIRE(After(&engine, params, now, before, first, &second, &report) == STARFOCUS_OK);
  CHECK(report.reused_blocks >= 80 - 12);
  CHECK(report.reused_blocks < 80);
  CHECK(report.rendered_samples * 2 < whole.rendered_samples);
  CHECK(report.rendered_samples > 0);
}

TEST_CASE("previous frame: in blur mode, all blocks are reused if only a side view changes") {
  const test::Scene before = test::LayeredScene(100, 100, 5, 2, 6);
  test::Engine engine(test::ConfigFor(before, 4));
  const starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLUR);
  test::Output second(100, 100);
  const test::Output first = test::OutputOf(&engine, params, before);
  test::Scene now = before;
  now.Pixel(3, 50, 50)[1] ^= 1;
  test::Report report;
  REQUIRE(After(&engine, params, now, before, first, &second, &report) == STARFOCUS_OK);
  CHECK(report.reused_blocks == 4);
  CHECK(first.bytes == second.bytes);
}

}  // namespace
}  // namespace after_test
