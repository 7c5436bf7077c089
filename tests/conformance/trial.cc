// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/trial.h"

#include <algorithm>
#include <cmath>

#include "simd/kernels.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/engine_blocks.h"
#include "tests/conformance/reference.h"
#include "tests/support/config.h"
#include "tests/support/shapes.h"

namespace conformance {
namespace {

double OneOf(std::initializer_list<double> values, test::Random* random) {
  return values.begin()[random->Int(0, int(values.size()) - 1)];
}

// Makes a chequerboard of near and far rectangles of one or more pixels.
void Alternate(test::Scene* scene, test::Random* random) {
  const int step_x = random->Int(1, 5), step_y = random->Int(1, 5);
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      const bool near = (x / step_x + y / step_y) % 2 == 1;
      scene->Disparity(x, y) = near ? scene->disparity_max : scene->disparity_min;
    }
  }
}

// In all views, gives near pixels one colour and far pixels another colour, with a little noise.
// Pixels at edges may then be any mixture of the near and the far colour.
void TwoColours(test::Scene* scene, test::Random* random) {
  const int noise = 1 << random->Int(0, 6);
  const float middle = 0.5F * (scene->disparity_min + scene->disparity_max);
  uint8_t colours[2][3];
  for (auto& colour : colours) {
    for (uint8_t& level : colour) level = random->Byte();
  }
  for (int view = 0; view < scene->views(); ++view) {
    for (int y = 0; y < scene->height; ++y) {
      for (int x = 0; x < scene->width; ++x) {
        const uint8_t* colour = colours[scene->Disparity(x, y) > middle ? 1 : 0];
        for (int c = 0; c < 3; ++c) {
          scene->Pixel(view, x, y)[c] =
              uint8_t(std::clamp(colour[c] + random->Int(-noise, noise), 0, 255));
        }
      }
    }
  }
}

// Copies the centre view to all views.
void RepeatCentre(test::Scene* scene) {
  for (auto& picture : scene->pictures) picture = scene->pictures[0];
}

test::Scene AnyScene(test::Random* random) {
  const double depth =
      OneOf({0, random->Real(0, 3), random->Real(0, 12), random->Real(0, 60)}, random);
  const double low = random->Int(0, 9) == 0 ? random->Real(-400, 400) : random->Real(-9, 9);
  test::Scene scene = test::EmptyScene(random->Int(1, 40), random->Int(1, 32),
                                       kStars[random->Int(0, 3)], float(low), float(low + depth));
  const int kind = random->Int(0, 4);
  if (kind == 4) {
    Alternate(&scene, random);
  } else {
    SetDepth(Depth(kind), &scene, random);
  }
  const int colours = random->Int(0, 3);
  if (colours == 3) {
    TwoColours(&scene, random);
  } else {
    SetColours(Colours(colours), &scene, random);
  }
  if (random->Int(0, 3) == 0) RepeatCentre(&scene);
  return scene;
}

// Returns a random blur radius. Small radii are more frequent than large radii.
double LargestRadius(bool wide, test::Random* random) {
  const double part = random->Unit();
  return (wide ? 40 : 6) * part * part;
}

void SetLens(Trial* trial, test::Random* random) {
  const test::Scene& scene = trial->scene;
  const double half = 0.5 * (double{scene.disparity_max} - scene.disparity_min);
  const double centre = 0.5 * (double{scene.disparity_max} + scene.disparity_min);
  const bool benchmark = random->Int(0, 5) == 0;
  const double radius = LargestRadius(!benchmark, random);
  double aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.02, 1);
  if (aperture * half > radius) aperture = std::max(radius / half, 1e-3);
  const double offset = std::max(0.0, radius / aperture - half);
  const double focus = centre + (random->Int(0, 1) == 0 ? offset : -offset);
  const starfocus_mode mode = benchmark                ? STARFOCUS_MODE_BENCHMARK
                              : random->Int(0, 3) == 0 ? STARFOCUS_MODE_FRAME
                                                       : STARFOCUS_MODE_BLOCK;
  trial->params = test::Params(focus, aperture, mode);
  trial->params.study.renderer =
      random->Int(0, 3) == 0 ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_SLICES;
}

// Extends the focus of every third lens to a range, which may contain all disparities.
void SetRange(Trial* trial, test::Random* random) {
  if (random->Int(0, 2) != 0) return;
  starfocus::Params& lens = trial->params;
  const double widest = 1 + 1.2 * std::max(trial->scene.disparity_max - lens.focus,
                                           lens.focus - trial->scene.disparity_min);
  lens.focus_nearer = random->Int(0, 2) == 0 ? 0 : random->Real(0, widest);
  lens.focus_farther = random->Int(0, 2) == 0 ? 0 : random->Real(0, widest);
}

double RadiusOf(const Trial& trial) {
  return reference::LargestBlur(trial.params, trial.scene.disparity_min, trial.scene.disparity_max);
}

void SetConfig(Trial* trial, test::Random* random) {
  const double radius = RadiusOf(*trial);
  test::Config& config = trial->config;
  config = test::ConfigFor(trial->scene, std::max(0.5, radius));
  // The reference has no thin structures, which random disparities contain.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  config.superblock = random->Int(0, 3) == 0 ? 64 : 32;
  config.tuning.max_layer = random->Int(0, STARFOCUS_LAYERS - 1);
  // The thresholds of deblocking magnify rounding errors. deblock_test tests deblocking.
  config.tuning.deblocking = 0;
  config.tuning.gather = random->Int(0, 3) == 0 ? 0 : 1;
  // A low cost per block makes the partition fine, and a high cost makes the partition coarse.
  if (random->Int(0, 1) == 0) config.tuning.timing.block = 1u << random->Int(0, 26);
  if (random->Int(0, 1) == 0) {
    trial->params.theta = OneOf({STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA,
                                 random->Real(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA)},
                                random);
  }
  if (random->Int(0, 1) == 0)
    config.tuning.n_scale = random->Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
  config.transfer = random->Int(0, 1) == 0 ? STARFOCUS_TRANSFER_SRGB : STARFOCUS_TRANSFER_NONE;
  const int lamps = random->Int(0, 5);
  if (lamps < 2) config.highlights = float(random->Real(1, lamps == 0 ? 4 : 16));
  if (random->Int(0, 1) == 0) test::RandomShape(&trial->params, random);
  test::ReserveFor(trial->params, &config);
}

}  // namespace

std::string Trial::Text() const {
  std::string all = TextOf(scene, params, config);
  for (const starfocus_position& at : scene.positions) {
    char text[80];
    std::snprintf(text, sizeof(text), ", view (%.9g, %.9g)", at.u, at.v);
    all += text;
  }
  return all;
}

Trial MakeTrial(uint64_t seed, bool anywhere) {
  test::Random random(seed);
  Trial trial;
  trial.scene = AnyScene(&random);
  SetLens(&trial, &random);
  SetConfig(&trial, &random);
  if (anywhere && trial.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN) {
    test::RandomViews(&trial.scene, &trial.config, &random);
  }
  SetRange(&trial, &random);
  return trial;
}

int MostLevels(const Trial& trial) { return trial.config.highlights > 1 ? 2 : 1; }

Distance Measure(const Trial& trial) {
  test::Engine engine(trial.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  const EngineResult result =
      RunEngine(trial.scene, trial.params, starfocus::simd::ReferenceKernels(), &engine);
  REQUIRE(result.status == STARFOCUS_OK);
  return Compare(result.bytes,
                 reference::RefocusBlocks(trial.scene, trial.params, trial.config, result.blocks));
}

}  // namespace conformance
