// SPDX-License-Identifier: Apache-2.0
// Compares the range of levels in a refocused picture with the range of levels in the views.
// starfocus.h states by how much pictures of STARFOCUS_MODE_BLOCK may exceed the range.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace input_range_slow_test {
namespace {

// Fills all views with two levels, in squares or stripes of a few pixels or at random.
void DrawTwoLevels(int low, int high, test::Random* random, test::Scene* scene) {
  const int kind = random->Int(0, 3), side_x = random->Int(1, 12), side_y = random->Int(1, 12);
  const bool alike = random->Int(0, 2) > 0;
  for (int view = 0; view < scene->views(); ++view) {
    for (int y = 0; y < scene->height; ++y) {
      for (int x = 0; x < scene->width; ++x) {
        bool bright = random->Int(0, 1) == 1;
        if (kind == 1) bright = (x / side_x + y / side_y) % 2 == 1;
        if (kind == 2) bright = x >= side_x && x < 2 * side_x && y >= side_y && y < 3 * side_y;
        if (kind == 3) bright = x % (side_x + 1) == 0 || y % (side_y + 1) == 0;
        std::fill_n(scene->Pixel(view, x, y), 3, uint8_t(bright ? high : low));
      }
    }
    if (alike && view > 0) scene->pictures[size_t(view)] = scene->pictures[0];
  }
}

struct Trial {
  test::Scene scene;
  test::Config config;
  starfocus::Params params;
  int low, high;
};

// Set of openings from which a trial takes a random opening.
enum class Openings { kDefault, kAnyTheta, kAnyShape };

Trial MakeTrial(uint64_t seed, starfocus_mode mode, starfocus_renderer renderer,
                Openings openings) {
  constexpr int kViews[] = {1, 5, 9, 17};
  test::Random random(seed);
  Trial trial;
  const double range = random.Int(0, 1) * random.Real(0, 4);
  const int width = random.Int(8, 64), height = random.Int(8, 48);
  trial.scene = test::EmptyScene(width, height, kViews[random.Int(0, 3)], 0, float(range));
  test::RandomDisparity(&trial.scene, &random);
  trial.low = random.Int(0, 120);
  trial.high = random.Int(trial.low + 1, 255);
  DrawTwoLevels(trial.low, trial.high, &random, &trial.scene);
  const double radius = random.Real(1, 40);
  trial.params = test::Params(random.Int(0, 1) == 0 ? range + radius : -radius, 1, mode);
  trial.params.study.renderer = renderer;
  trial.config = test::ConfigFor(trial.scene, radius + range + 1);
  trial.config.transfer = seed % 2 == 0 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
  if (openings == Openings::kAnyTheta) {
    trial.params.theta = random.Int(0, 1) == 0
                             ? STARFOCUS_MAX_THETA
                             : random.Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA);
  }
  if (openings == Openings::kAnyShape) test::RandomShape(&trial.params, &random);
  test::ReserveFor(trial.params, &trial.config);
  return trial;
}

// Amount by which the levels of a picture exceed the range of levels in its views.
struct Beyond {
  int levels = 0;
  // Largest overshoot beyond one level of rounding, as a fraction of the difference of light
  // between the low and the high level.
  double contrast = 0;
};

// Refocuses the picture of a trial and updates `worst`.
void Widen(const Trial& trial, Beyond* worst) {
  const test::Output out = test::OutputOf(trial.config, trial.params, trial.scene);
  int below = 0, above = 0;
  for (const uint8_t level : out.bytes) {
    below = std::max(below, trial.low - level);
    above = std::max(above, level - trial.high);
  }
  worst->levels = std::max({worst->levels, below, above});
  const auto light = [&](int level) { return test::LightOf(level, trial.config.transfer); };
  const double contrast = light(trial.high) - light(trial.low);
  if (below > 0) {
    const double less = light(trial.low) - light(trial.low - below + 1);
    worst->contrast = std::max(worst->contrast, less / contrast);
  }
  if (above > 0) {
    const double more = light(trial.high + above - 1) - light(trial.high);
    worst->contrast = std::max(worst->contrast, more / contrast);
  }
}

Beyond WorstOf(starfocus_mode mode, starfocus_renderer renderer, Openings openings) {
  const uint64_t kTrials = mode == STARFOCUS_MODE_BLOCK ? 300 : 60;
  Beyond worst;
  for (uint64_t seed = 1; seed <= kTrials; ++seed) {
    CAPTURE(seed);
    Widen(MakeTrial(seed, mode, renderer, openings), &worst);
  }
  constexpr const char* kNames[] = {"default opening", "any theta", "any shape"};
  std::printf("mode %d, rule %d, %s: %d levels, %.3f of the contrast\n", int(mode), int(renderer),
              kNames[int(openings)], worst.levels, worst.contrast);
  return worst;
}

}  // namespace

TEST_CASE("input range: pictures of frame and benchmark mode stay within the levels of the views") {
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      for (const Openings openings : {Openings::kAnyTheta, Openings::kAnyShape}) {
        CHECK(WorstOf(mode, renderer, openings).levels == 0);
      }
    }
  }
}

TEST_CASE("input range: pictures of block mode overshoot by no more than starfocus.h states") {
  for (const Openings openings : {Openings::kDefault, Openings::kAnyTheta, Openings::kAnyShape}) {
    const auto contrast = [&](starfocus_renderer renderer) {
      return WorstOf(STARFOCUS_MODE_BLOCK, renderer, openings).contrast;
    };
    CHECK(contrast(STARFOCUS_RENDERER_SLICES) <= 0.04);
    CHECK(contrast(STARFOCUS_RENDERER_LINE_SCAN) <= (openings == Openings::kDefault ? 0.13 : 0.5));
  }
}

}  // namespace input_range_slow_test
