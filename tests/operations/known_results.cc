// SPDX-License-Identifier: Apache-2.0
// Families of pictures whose result is known or bounded.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "starfocus/experimental.h"
#include "tests/operations/families.h"
#include "tests/operations/rig.h"
#include "tests/operations/setup.h"
#include "tests/support/transfer_curve.h"

namespace starfocus::stress {
namespace {

// Largest allowed change of the mean brightness, in grey levels.
constexpr double kMostEnergy = 0.05;
// Inverting a picture inverts the result, except for the rounding of halves. Rounding occurs once
// per pixel at layer 0, and a few times more at other layers.
constexpr int kMostInversion = 2;
// Returns the largest overshoot as a share of the step. Overshoot exists because the resampling
// filters have negative lobes. Without blur, subsampling by two layers and upsampling again
// overshoots by 0.144. Blur removes most of the overshoot, and removes more from radius 4 than from
// radius 3. Apertures steeper than the default are nearly pinholes, whose blur does not remove the
// overshoot.
double MostOvershoot(const Setup& setup) {
  const bool steep = setup.params.theta > test::Params(0).theta;
  if (setup.params.study.renderer != STARFOCUS_RENDERER_LINE_SCAN && setup.Radius() >= 4)
    return steep ? 0.1 : 0.02;
  return steep ? 0.144 : 0.03;
}

void Invert(Setup* setup) {
  for (auto& picture : setup->scene.pictures) {
    for (uint8_t& sample : picture) sample = static_cast<uint8_t>(255 - sample);
  }
}

bool MayResample(const Setup& setup) {
  return setup.params.study.mode == STARFOCUS_MODE_BLOCK && setup.config.tuning.max_layer > 0;
}

// Smallest and largest sample of the views.
struct Levels {
  int low = 255, high = 0;
};
Levels LevelsOf(const Setup& setup) {
  Levels levels;
  for (const auto& picture : setup.scene.pictures) {
    for (size_t i = 0; i < picture.size(); ++i) {
      if (i % setup.scene.stride >= 3 * static_cast<size_t>(setup.scene.width)) continue;
      levels.low = std::min<int>(levels.low, picture[i]);
      levels.high = std::max<int>(levels.high, picture[i]);
    }
  }
  return levels;
}

// The inverted light field must give the inverted picture. If all weights are positive, no sample
// may lie outside the levels of the views. Outcome::error is the largest difference from the
// inverted picture.
Outcome CheckInversion(Setup setup, test::Random* random) {
  const std::vector<uint8_t> plain = Refocused(setup, RandomVariant(random));
  if (!MayResample(setup)) {
    const Levels levels = LevelsOf(setup);
    for (const uint8_t sample : plain) {
      if (sample < levels.low || sample > levels.high) {
        return Fail(setup,
                    "level " + std::to_string(sample) + " is outside the range of the views");
      }
    }
  }
  // Codes are not proportional to light, so the inverse of a picture is not the inverse of its
  // light.
  if (setup.config.transfer != STARFOCUS_TRANSFER_NONE) return {0, ""};
  Setup inverted = setup;
  Invert(&inverted);
  const std::vector<uint8_t> other = Refocused(inverted, RandomVariant(random));
  Outcome outcome;
  for (size_t i = 0; i < plain.size(); ++i) {
    outcome.error = std::max<double>(outcome.error, std::abs(plain[i] + other[i] - 255));
  }
  // Deblocking compares rounded differences with a threshold, so a picture and its inverse may be
  // deblocked differently.
  const bool deblocked = MayResample(setup) && setup.config.tuning.deblocking > 0;
  const double most = deblocked ? setup.config.tuning.deblocking + kMostInversion : kMostInversion;
  if (outcome.error > most)
    return Fail(setup, "the inverse of the result for the inverted picture differs by " +
                           std::to_string(int(outcome.error)));
  return outcome;
}

void Fill(test::Scene* scene, uint8_t red, uint8_t green, uint8_t blue) {
  const uint8_t colour[3] = {red, green, blue};
  for (int view = 0; view < scene->views(); ++view) {
    for (int y = 0; y < scene->height; ++y) {
      for (int x = 0; x < scene->width; ++x) std::copy_n(colour, 3, scene->Pixel(view, x, y));
    }
  }
}

// Refocuses a picture of one colour. Outcome::error is the largest change of a sample.
Outcome CheckConstant(Setup setup, test::Random* random) {
  const uint8_t colour[3] = {random->Byte(), random->Byte(),
                             static_cast<uint8_t>(255 * random->Int(0, 1))};
  Fill(&setup.scene, colour[0], colour[1], colour[2]);
  const std::vector<uint8_t> out = Refocused(setup, RandomVariant(random));
  Outcome outcome;
  for (size_t i = 0; i < out.size(); ++i) {
    outcome.error = std::max<double>(outcome.error, std::abs(out[i] - colour[i % 3]));
  }
  if (outcome.error != 0) return Fail(setup, "the level of a constant picture changes");
  return outcome;
}

// Makes a setup with the whole range of disparities and an aperture so narrow that the blur stays
// small.
Setup RangeSetup(float low, float high, double radius, test::Random* random) {
  constexpr int kViews[] = {1, 5, 9, 17};
  Setup setup;
  setup.scene = test::EmptyScene(random->Int(1, 24), random->Int(1, 24), kViews[random->Int(0, 3)],
                                 low, high);
  SetDepth(static_cast<Depth>(random->Int(0, 4)), &setup.scene, random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &setup.scene, random);
  RandomLens(radius, 4, &setup, random);
  return setup;
}

}  // namespace

Outcome Constant(test::Random* random) {
  return CheckConstant(RandomSetup({40, 8, 4, 8}, random), random);
}

Outcome Squares(test::Random* random) {
  Setup setup = RandomSetup({40, 8, 4, 8}, random);
  test::Scene& scene = setup.scene;
  Fill(&scene, 0, 0, 0);
  const int side = random->Int(1, std::max(scene.width, scene.height));
  const int x0 = random->Int(1 - side, scene.width - 1);
  const int y0 = random->Int(1 - side, scene.height - 1);
  for (int view = 0; view < scene.views(); ++view) {
    for (int y = std::max(0, y0); y < std::min(scene.height, y0 + side); ++y) {
      for (int x = std::max(0, x0); x < std::min(scene.width, x0 + side); ++x) {
        std::fill_n(scene.Pixel(view, x, y), 3, uint8_t{255});
      }
    }
  }
  return CheckInversion(setup, random);
}

Outcome Limits(test::Random* random) {
  // In benchmark mode, the number of views grows with the square of the radius. Cases in benchmark
  // mode are therefore rare and have one pixel.
  const int kind = random->Int(0, 63);
  Setup setup;
  constexpr int kViews[] = {1, 5, 9, 17};
  const int side = kind == 0 ? 1 : kind < 4 ? 2 : 5;
  const float spread = static_cast<float>(random->Int(0, 1) * random->Real(0, 200));
  setup.scene = test::EmptyScene(random->Int(1, side), random->Int(1, side),
                                 kViews[random->Int(0, 3)], -spread, spread);
  SetDepth(static_cast<Depth>(random->Int(0, 4)), &setup.scene, random);
  SetColours(Colours::kExtreme, &setup.scene, random);
  const double radius = kind == 0 ? 16 : kind < 4 ? STARFOCUS_MAX_BLUR : random->Int(13, 30);
  RandomLens(radius, 4, &setup, random);
  setup.params.study.mode = kind == 0 ? int{STARFOCUS_MODE_BENCHMARK} : random->Int(0, 1) + 2;
  setup.config.superblock = 32;
  if (setup.Radius() > STARFOCUS_MAX_BLUR)
    setup.params.aperture *= STARFOCUS_MAX_BLUR / setup.Radius() * 0.999999;
  FitBlur(&setup);
  return random->Int(0, 1) == 0 ? CheckConstant(setup, random) : CheckInversion(setup, random);
}

Outcome Thresholds(test::Random* random) {
  constexpr int kSides[] = {1, 15, 16, 17, 31, 32, 33, 47, 48, 49, 63, 64, 65};
  const int width = kSides[random->Int(0, random->Int(2, 12))];
  const int height = kSides[random->Int(0, random->Int(2, 6))];
  Setup setup = FlatSetup(width, height, RandomRadius(8, random), random);
  SetColours(static_cast<Colours>(random->Int(0, 2)), &setup.scene, random);
  return CheckInversion(setup, random);
}

Outcome FarFocus(test::Random* random) {
  const Bounds bounds = {24, 6, 4, static_cast<float>(random->Int(0, 1) == 0 ? 2 : 100)};
  Setup setup = RandomSetup(bounds, random);
  const double distance = std::pow(10.0, random->Real(1, 5.9));
  const bool in_front = random->Int(0, 1) == 0;
  SetFocus(in_front ? distance : -distance, in_front, &setup.params, random);
  setup.params.aperture = 1;
  setup.params.aperture = std::min(1.0, random->Real(0.01, 6) / setup.Radius());
  FitBlur(&setup);
  RandomMode(4, &setup, random);
  return random->Int(0, 1) == 0 ? CheckConstant(setup, random) : CheckInversion(setup, random);
}

Outcome Extremes(test::Random* random) {
  const float most = static_cast<float>(STARFOCUS_MAX_DISPARITY);
  const int kind = random->Int(0, 2);
  const float low = kind == 0 ? most - 1.0f / 64 * random->Int(0, 300) : -most;
  const float high = kind == 1 ? -most + 1.0f / 64 * random->Int(0, 300) : most;
  const Setup setup = RangeSetup(low, high, RandomRadius(8, random), random);
  return random->Int(0, 1) == 0 ? CheckConstant(setup, random) : CheckInversion(setup, random);
}

Outcome Noise(test::Random* random) {
  Setup setup = RandomSetup({32, 8, 4, 16}, random);
  // wrong coverage would make the light of near surfaces darker or lighter than in any view
  setup.scene.coverage.clear();
  SetDepth(Depth::kNoisy, &setup.scene, random);
  SetColours(Colours::kNoise, &setup.scene, random);
  return CheckInversion(setup, random);
}

// The second half of each period of the content is the inverse of the first half around an integer
// level. Rounding errors of both halves cancel, so the mean must not change.
Outcome Energy(test::Random* random) {
  constexpr int kPeriod = 16;
  const double radius = RandomRadius(random->Int(0, 3) == 0 ? 7 : 4, random);
  const int margin = static_cast<int>(radius) + 16;
  const int side = 2 * margin + kPeriod;
  Setup setup = FlatSetup(side, side, radius, random);
  // Without a transfer function, codes are averaged.
  setup.config.transfer = STARFOCUS_TRANSFER_NONE;
  const int mean = random->Int(20, 235);
  // The range of levels leaves room for the overshoot of the filters of layers, so that nothing is
  // clipped.
  const int amplitude = std::max(1, static_cast<int>(std::min(mean, 255 - mean) / 1.8));
  int pattern[kPeriod][kPeriod];
  for (auto& row : pattern) {
    for (int x = 0; x < kPeriod / 2; ++x) {
      row[x] = mean + random->Int(-amplitude, amplitude);
      row[x + kPeriod / 2] = 2 * mean - row[x];
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      std::fill_n(setup.scene.Pixel(0, x, y), 3,
                  static_cast<uint8_t>(pattern[y % kPeriod][x % kPeriod]));
    }
  }
  const std::vector<uint8_t> out = Refocused(setup, RandomVariant(random));
  int64_t sum = 0;
  for (int y = margin; y < margin + kPeriod; ++y) {
    for (int x = margin; x < margin + kPeriod; ++x) sum += out[3 * size_t(y * side + x)];
  }
  const double got = static_cast<double>(sum) / (kPeriod * kPeriod);
  if (std::fabs(got - mean) > kMostEnergy) {
    return Fail(setup,
                "the mean level is " + std::to_string(got) + " instead of " + std::to_string(mean));
  }
  return {std::fabs(got - mean), ""};
}

// Refocuses a step between two levels. Outcome::error is the overshoot beyond either level, as a
// share of the step.
Outcome Steps(test::Random* random) {
  const int length = random->Int(8, 72), across = random->Int(1, 20);
  const bool upright = random->Int(0, 1) == 1;
  Setup setup = FlatSetup(upright ? across : length, upright ? length : across,
                          RandomRadius(10, random), random);
  const int low = random->Int(0, 120), high = random->Int(low + 1, 255);
  const int edge = random->Int(1, length - 1);
  test::Scene& scene = setup.scene;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t((upright ? y : x) < edge ? low : high));
    }
  }
  const std::vector<uint8_t> out = Refocused(setup, RandomVariant(random));
  const bool positive = !MayResample(setup);
  const auto light = [&](int code) { return test::LightOf(code, setup.config.transfer); };
  double over = 0;  // overshoot in light, minus the rounding error of one code
  for (int k = 0; k < length; ++k) {
    const auto at = [&](int along) {
      return int{out[3 * size_t(upright ? along * across : along)]};
    };
    if (positive && (at(k) < low || at(k) > high)) return Fail(setup, "a blurred step overshoots");
    over = std::max({over, light(low) - light(at(k) + 1), light(at(k) - 1) - light(high)});
    if (positive && k > 0 && at(k) < at(k - 1))
      return Fail(setup, "a blurred step is not monotone");
  }
  const double step = light(high) - light(low);
  if (over > MostOvershoot(setup) * step)
    return Fail(setup, "a blurred step overshoots by " + std::to_string(over) + ", its height is " +
                           std::to_string(step));
  return {over / step, ""};
}

}  // namespace starfocus::stress
