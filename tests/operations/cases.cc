// SPDX-License-Identifier: Apache-2.0
#include "tests/operations/cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "tests/support/hair.h"
#include "tests/support/scenes.h"
#include "tests/support/shapes.h"

namespace properties {
namespace {

constexpr int kBlockSizes[] = {32, 64, 128, 256};
constexpr const char* kModes[] = {"frame", "benchmark", "block", "blur"};
// Radii at which N changes by (9), or the layer L changes by (12).
constexpr double kThresholds[] = {0.5, 1, 2, 3, 4, 4 / 0.787, 6, 8, 12};
// Largest width of a range in focus, in 1/64 pixel per unit of u.
constexpr int kWidestRange = 8 * 64;

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

// Returns a value in [low, high]. In half of all calls, the value is `low` or `high`.
double OftenAnEnd(double low, double high, test::Random* random) {
  const int end = random->Int(0, 3);
  return end == 0 ? low : end == 1 ? high : random->Real(low, high);
}

// Largest number of rendered views times pixels, for modes whose number of views grows with the
// radius.
constexpr double kMostWork = 300000;

bool IsLineByLine(const Case& of) {
  const starfocus::Params& params = of.params;
  return params.study.renderer == STARFOCUS_RENDERER_LINE_SCAN ||
         params.study.mode == STARFOCUS_MODE_BENCHMARK ||
         (params.study.mode == STARFOCUS_MODE_FRAME &&
          params.study.renderer == STARFOCUS_RENDERER_AUTO && of.config.views > 1);
}

// Limits the work of the line scan, whose number of views grows with the square of the radius.
void LimitWork(Case* of) {
  const double n = 1 + of->Radius() * std::max(1.0, of->config.tuning.n_scale);
  const double views = 3.2 * n * n * (of->params.study.mode == STARFOCUS_MODE_BENCHMARK ? 4 : 1);
  if (!IsLineByLine(*of) || views * of->config.width * of->config.height < kMostWork) return;
  of->params.study.mode = STARFOCUS_MODE_BLOCK;
  of->params.study.renderer = STARFOCUS_RENDERER_SLICES;
}

// Makes parts of some rows unknown.
void ForgetDepth(Case* of, test::Random* random) {
  of->config.unknown = STARFOCUS_UNKNOWN_FILL;
  for (int y = 0; y < of->scene.height; ++y) {
    const int first = random->Int(1, of->scene.width), last = random->Int(0, of->scene.width - 1);
    for (int x = first; x <= last; ++x) {
      of->scene.Disparity(x, y) = std::numeric_limits<float>::infinity();
    }
  }
}

}  // namespace

double Case::Radius() const {
  const starfocus::Params& lens = params;
  const double nearer = config.disparity_max - (lens.focus + lens.focus_nearer);
  const double farther = lens.focus - lens.focus_farther - config.disparity_min;
  return lens.aperture * std::max({0.0, nearer, farther});
}

std::string Case::Text() const {
  return std::to_string(config.width) + "x" + std::to_string(config.height) + ", " +
         std::to_string(config.views) + " views, " + kModes[params.study.mode] + ", renderer " +
         std::to_string(params.study.renderer) + ", disparity [" + Number(config.disparity_min) +
         ", " + Number(config.disparity_max) + "], focus " + Number(params.focus) + " - " +
         Number(params.focus_farther) + " + " + Number(params.focus_nearer) + ", aperture " +
         Number(params.aperture) + ", max_blur " + Number(config.max_blur) + ", block " +
         std::to_string(config.superblock) + ", layers " + std::to_string(config.tuning.max_layer) +
         ", deblocking " + std::to_string(config.tuning.deblocking) + ", transfer " +
         std::to_string(config.transfer) + ", highlights " + Number(double{config.highlights}) +
         ", theta " + Number(params.theta) + ", n_scale " + Number(config.tuning.n_scale) +
         (config.tuning.gather != 0 ? "" : ", nothing gathered") +
         (scene.coverage.empty() ? "" : ", coverage") +
         (config.unknown == STARFOCUS_UNKNOWN_FILL ? ", unknown" : "") + ", " +
         test::ShapeText(params);
}

double RandomRadius(double largest, test::Random* random) {
  if (random->Int(0, 1) == 0) {
    const double threshold = kThresholds[random->Int(0, 8)];
    const double offset = random->Int(-2, 2) / 64.0;
    if (threshold + offset <= largest) return threshold + offset;
  }
  const double part = random->Unit();
  return largest * part * part;
}

void SetDepth(Depth depth, test::Scene* scene, test::Random* random) {
  if (depth == Depth::kPiecewise) return test::RandomDisparity(scene, random);
  if (depth == Depth::kNoisy) return test::NoisyDisparity(scene, random);
  if (depth == Depth::kSurfaces) return test::SetSurfaces(scene, random);
  const double low = scene->disparity_min, high = scene->disparity_max;
  const double base = random->Real(low, high);
  const bool slanted = depth == Depth::kSlanted;
  const double dx = slanted ? random->Real(-0.3, 0.3) : 0;
  const double dy = slanted ? random->Real(-0.3, 0.3) : 0;
  const int step_x = random->Int(1, 3), step_y = random->Int(1, 3);
  const double far = random->Int(0, 1) == 0 ? low : high;
  std::vector<double> levels(static_cast<size_t>(random->Int(5, 16)));
  for (double& level : levels) level = random->Real(low, high);
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      const bool odd = (x / step_x + y / step_y) % 2 == 1;
      const bool rim = x == 0 || y == 0 || x == scene->width - 1 || y == scene->height - 1;
      double value = base + dx * x + dy * y;
      if (depth == Depth::kAlternating) value = odd ? high : low;
      if (depth == Depth::kFramed && rim) value = far;
      if (depth == Depth::kLevels) value = levels[random->Next() % levels.size()];
      if (depth == Depth::kSparse && random->Int(0, 40) == 0) value = far;
      scene->Disparity(x, y) =
          std::clamp(static_cast<float>(value), scene->disparity_min, scene->disparity_max);
    }
  }
}

void SetStrands(test::Scene* scene, test::Random* random) {
  const test::Strands strands = test::DrawStrands(random);
  const int near[3] = {random->Byte(), random->Byte(), random->Byte()};
  const int far[3] = {random->Byte(), random->Byte(), random->Byte()};
  const float range = scene->disparity_max - scene->disparity_min;
  const bool given = random->Int(0, 1) == 0;
  for (int y = 0; y < scene->height; ++y) {
    for (int x = 0; x < scene->width; ++x) {
      const float depth = static_cast<float>(strands.DepthAt(x, y)) / 255.0f;
      scene->Disparity(x, y) = std::min(scene->disparity_min + depth * range, scene->disparity_max);
      if (given) scene->coverage.push_back(static_cast<uint8_t>(strands.CoverageAt(x, y)));
      for (int view = 0; view < scene->views(); ++view) {
        const starfocus_position at = scene->PositionOf(view);
        const auto right = static_cast<int>(std::lround(at.u * scene->disparity_max));
        const auto down = static_cast<int>(std::lround(at.v * scene->disparity_max));
        const int coverage = strands.CoverageAt(x + right, y + down);
        for (int c = 0; c < 3; ++c) {
          scene->Pixel(view, x, y)[c] = test::Mixture(coverage, near[c], far[c]);
        }
      }
    }
  }
}

void SetColours(Colours colours, test::Scene* scene, test::Random* random) {
  const int amplitude = 1 << random->Int(0, 7);
  for (auto& picture : scene->pictures) {
    int level = random->Int(0, 255);
    const int base = level;
    for (uint8_t& sample : picture) {
      if (colours == Colours::kSmooth) level += random->Int(-9, 9);
      if (colours == Colours::kExtreme) level = random->Int(0, 1) * 255;
      if (colours == Colours::kNoise) level = base + random->Int(-amplitude, amplitude);
      if (colours == Colours::kPlainCentre && &picture != &scene->pictures[0]) {
        level = base + random->Int(-amplitude, amplitude);
      }
      level = std::clamp(level, 0, 255);
      sample = static_cast<uint8_t>(level);
    }
  }
}

void SetColour(const uint8_t rgb[3], test::Scene* scene) {
  for (int view = 0; view < scene->views(); ++view) {
    for (int y = 0; y < scene->height; ++y) {
      for (int x = 0; x < scene->width; ++x) std::copy_n(rgb, 3, scene->Pixel(view, x, y));
    }
  }
}

void FitBlur(Case* of) {
  const double radius = of->Radius();
  of->config.max_blur = radius > 0 ? radius : 0.5;
}

void RandomMode(Case* of, test::Random* random) {
  of->params.study.mode = random->Int(STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLUR);
  of->params.study.renderer = random->Int(STARFOCUS_RENDERER_AUTO, STARFOCUS_RENDERER_SLICES);
  // In benchmark mode, the number of views is proportional to the square of twice the radius.
  if (of->params.study.mode == STARFOCUS_MODE_BENCHMARK && of->Radius() > 4) {
    of->params.study.mode = STARFOCUS_MODE_BLOCK;
  }
}

void SetFocus(double end, bool in_front, starfocus_params* lens, test::Random* random) {
  const double width = (random->Int(0, 1) == 0 ? 0 : random->Int(1, kWidestRange)) / 64.0;
  const double toward = 0.5 * random->Int(0, 2) * width, away = width - toward;
  lens->focus = in_front ? end + toward : end - toward;
  lens->focus_farther = in_front ? toward : away;
  lens->focus_nearer = in_front ? away : toward;
}

void RandomLens(double radius, Case* of, test::Random* random) {
  const test::Scene& scene = of->scene;
  const double half = 0.5 * (double{scene.disparity_max} - scene.disparity_min);
  const double centre = 0.5 * (double{scene.disparity_max} + scene.disparity_min);
  double aperture = random->Int(0, 1) == 0 ? 1 : random->Real(0.05, 1);
  if (aperture * half > radius) aperture = std::max(radius / half, 1e-6);
  const double offset = std::max(0.0, radius / aperture - half);
  const bool in_front = random->Int(0, 1) == 0;
  of->params = test::Params(0, aperture);
  SetFocus(centre + (in_front ? offset : -offset), in_front, &of->params, random);
  of->config = test::ConfigFor(scene);
  of->config.superblock = kBlockSizes[std::min(random->Int(0, 3), random->Int(0, 3))];
  of->config.tuning.max_layer = random->Int(0, 3) == 0 ? random->Int(0, 1) : 2;
  if (random->Int(0, 3) == 0) of->config.tuning.deblocking = random->Int(0, 255);
  if (random->Int(0, 3) == 0) {
    of->params.theta = OftenAnEnd(STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA, random);
  }
  // A low cost per block makes the partition fine, and a high cost makes the partition coarse.
  if (random->Int(0, 1) == 0) of->config.tuning.timing.block = 1u << random->Int(0, 26);
  FitBlur(of);
  RandomMode(of, random);
  of->config.transfer = random->Int(0, 1) == 0 ? STARFOCUS_TRANSFER_SRGB : STARFOCUS_TRANSFER_NONE;
}

Case FlatCase(int width, int height, double radius, test::Random* random) {
  Case made;
  made.scene = test::EmptyScene(width, height, test::kStars[random->Int(0, 3)], 0, 0);
  RandomLens(radius, &made, random);
  made.params.aperture = 1;
  const bool in_front = random->Int(0, 1) == 0;
  SetFocus(in_front ? radius : -radius, in_front, &made.params, random);
  FitBlur(&made);
  RandomMode(&made, random);
  return made;
}

Case RandomCase(const Bounds& bounds, test::Random* random) {
  const bool any = bounds.least > 1 || random->Int(0, 3) == 0;
  const int low = any ? bounds.size : std::min(bounds.size, 20);
  Case made;
  const double a = random->Real(-bounds.disparity, bounds.disparity);
  // The scene has surfaces that are far apart, strands, or surfaces that are close together.
  const int kind = random->Int(0, 3);
  const bool strands = kind == 1;
  const double b = kind == 0 ? random->Real(-bounds.disparity, bounds.disparity)
                   : strands ? a + (a < 0 ? 1 : -1) * random->Real(5, 12)
                             : a + random->Real(-3, 3);
  // The search with given coverage covers a wide area around each pixel, which is slow under
  // sanitizers.
  const int least = strands ? std::min(16, low) : bounds.least,
            most = strands ? std::min(80, low) : low;
  made.scene = test::EmptyScene(
      random->Int(least, most), random->Int(least, most), test::kStars[random->Int(0, 3)],
      static_cast<float>(std::max<double>(-bounds.disparity, std::min(a, b))),
      static_cast<float>(std::min<double>(bounds.disparity, std::max(a, b))), random->Int(0, 3));
  RandomLens(RandomRadius(bounds.radius, random), &made, random);
  if (random->Int(0, 3) == 0) made.config.tuning.gather = 0;
  if (random->Int(0, 3) == 0)
    made.config.tuning.n_scale = OftenAnEnd(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE, random);
  // Pictures use a separate random generator, since a fuzzer does not supply enough bytes for
  // pictures.
  test::Random fill(random->Next());
  made.strands = strands;
  if (strands) {
    SetStrands(&made.scene, &fill);
  } else {
    SetDepth(static_cast<Depth>(random->Int(0, 8)), &made.scene, &fill);
    SetColours(static_cast<Colours>(random->Int(0, 3)), &made.scene, &fill);
  }
  if (fill.Int(0, 3) == 0) test::RandomShape(&made.params, &fill);
  test::ReserveFor(made.params, &made.config);
  return made;
}

Case RandomCase(test::Random* random) {
  // Larger blurs have smaller pictures and are selected less often.
  constexpr Bounds kRegimes[] = {
      {160, 3, 8}, {160, 6, 500}, {100, 16, 40}, {64, 50, 500}, {40, 128, 500}};
  Case made = RandomCase(kRegimes[std::min(random->Int(0, 4), random->Int(0, 4))], random);
  LimitWork(&made);
  if (random->Int(0, 7) == 0) made.config.superblock = 0;  // The library selects the block size.
  if (random->Int(0, 3) == 0)
    made.config.highlights = float(random->Real(1, STARFOCUS_MAX_HIGHLIGHTS));
  if (random->Int(0, 3) == 0) {
    made.config.max_blur =
        std::min(STARFOCUS_MAX_BLUR, std::ceil(made.config.max_blur) + random->Int(0, 8));
  }
  if (random->Int(0, 3) == 0) {
    starfocus_timing& timing = made.config.tuning.timing;
    for (uint32_t* coefficient : {&timing.block, &timing.field, &timing.a, &timing.b, &timing.c,
                                  &timing.upsample, &timing.span, &timing.hole}) {
      *coefficient = random->Int(0, 2) == 0 ? 0 : random->Next() % (STARFOCUS_MAX_TIMING + 1);
    }
  }
  if (made.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN && random->Int(0, 2) == 0) {
    test::RandomViews(&made.scene, &made.config, random);
  }
  if (!made.strands && random->Int(0, 5) == 0) ForgetDepth(&made, random);
  return made;
}

}  // namespace properties
