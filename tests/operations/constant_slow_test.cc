// SPDX-License-Identifier: Apache-2.0
// Tests that a constant picture does not change in any bit, since every filter has a gain of
// exactly 1.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

namespace constant_slow_test {
namespace {

struct Trial {
  int width = 1, height = 1, views = 17;
  float low = 0, high = 0;
  double focus = 0, aperture = 1;
  starfocus_mode mode = STARFOCUS_MODE_FRAME;
  int block = 64;
  bool noisy = false;
  // If above 0, the disparity of each pixel is chosen at random from `levels` values.
  int levels = 0;
  double max_blur = 64, n_scale = 1, theta = 0;  // Theta 0: default fall-off.
  starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO;
  int transfer = STARFOCUS_TRANSFER_SRGB;
  uint64_t shape = 0;  // seed of a random opening; 0: default opening
  std::array<uint8_t, 3> color = {0, 0, 0};
  uint64_t seed = 1;
  bool splits_thin =
      true;  // Pixels of thin structures, which random disparities contain, are split.
};

std::string Text(const Trial& t) {
  return std::to_string(t.width) + "x" + std::to_string(t.height) + " views " +
         std::to_string(t.views) + " disparity [" + std::to_string(t.low) + ", " +
         std::to_string(t.high) + "] focus " + std::to_string(t.focus) + " aperture " +
         std::to_string(t.aperture) + " mode " + std::to_string(t.mode) + " block " +
         std::to_string(t.block) + (t.noisy ? " noisy" : "") + " n_scale " +
         std::to_string(t.n_scale) + " theta " + std::to_string(t.theta) + " shape " +
         std::to_string(t.shape) + " seed " + std::to_string(t.seed);
}

// Refocuses a picture of the trial's colour. Returns the number of samples that changed by more
// than `most` codes.
int Changed(const Trial& t, int most = 0) {
  test::Random random(t.seed);
  test::Scene scene = test::EmptyScene(t.width, t.height, t.views, t.low, t.high);
  for (auto& picture : scene.pictures) {
    for (size_t i = 0; i < picture.size(); ++i) picture[i] = t.color[i % 3];
  }
  if (t.levels > 0) {
    for (float& disparity : scene.disparity) {
      disparity = t.low + (t.high - t.low) * random.Int(0, t.levels - 1) / (t.levels - 1);
    }
  } else if (t.noisy) {
    test::NoisyDisparity(&scene, &random);
  } else {
    test::RandomDisparity(&scene, &random);
  }
  test::Config config = test::ConfigFor(scene, t.max_blur);
  config.superblock = t.block;
  config.tuning.n_scale = t.n_scale;
  config.transfer = t.transfer;
  test::SetFeature(STARFOCUS_FEATURE_COVERAGE, t.splits_thin, &config.features);
  test::Random shapes(t.shape);
  starfocus::Params params = test::Params(t.focus, t.aperture, t.mode, t.renderer);
  if (t.theta > 0) params.theta = t.theta;
  if (t.shape != 0) test::RandomShape(&params, &shapes);
  test::ReserveFor(params, &config);
  const test::Output out = test::OutputOf(config, params, scene);
  int changed = 0;
  for (size_t i = 0; i < out.bytes.size(); ++i) {
    changed += std::abs(out.bytes[i] - t.color[i % 3]) > most ? 1 : 0;
  }
  return changed;
}

TEST_CASE("constant: a constant picture of any level is unchanged") {
  Trial t = {19, 11, 17, -2, 3};
  for (int views : test::kStars) {
    t.views = views;
    for (int level = 0; level < 256; level += (views == 17 ? 1 : 15)) {
      t.color.fill(static_cast<uint8_t>(level));
      t.seed = static_cast<uint64_t>(level) + 1;
      for (const int transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
        t.transfer = transfer;
        CHECK_MESSAGE(Changed(t) == 0, Text(t) << " level " << level);
      }
    }
  }
}

TEST_CASE("constant: for every N, a constant picture is unchanged") {
  Trial t = {21, 18};
  t.color = {255, 128, 1};
  for (int views : test::kStars) {
    t.views = views;
    for (int radius = 0; radius <= 24; ++radius) {
      for (starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
        if (mode == STARFOCUS_MODE_BENCHMARK && radius > 12) continue;
        t.low = static_cast<float>(-radius);
        t.high = static_cast<float>(radius) / 2;
        t.mode = mode;
        t.seed = static_cast<uint64_t>(radius) + 100;
        t.transfer = radius % 4 == 3 ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
        CHECK_MESSAGE(Changed(t) == 0, Text(t));
      }
    }
  }
}

TEST_CASE("constant: for every shape of the opening, a constant picture is unchanged") {
  Trial t = {70, 41};
  t.color = {255, 127, 1};
  // With sanitizers, a quarter of the shapes suffices, since these shapes execute all of the code.
  constexpr uint64_t kShapes = test::kSanitized ? 60 : 240;
  for (uint64_t shape = 1; shape <= kShapes; ++shape) {
    test::Random random(shape + 7000);
    t.shape = t.seed = shape;
    t.views = random.Int(0, 1) == 0 ? 1 : 9;
    t.mode = static_cast<starfocus_mode>(random.Int(STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLUR));
    t.renderer = static_cast<starfocus_renderer>(
        random.Int(STARFOCUS_RENDERER_AUTO, STARFOCUS_RENDERER_SLICES));
    const double radius = random.Real(0.2, t.mode == STARFOCUS_MODE_BENCHMARK ? 6 : 30);
    t.low = static_cast<float>(-radius);
    t.high = static_cast<float>(random.Real(-radius, radius));
    t.n_scale = random.Real(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE);
    t.block = 32 << random.Int(0, 2);
    CHECK_MESSAGE(Changed(t) == 0, Text(t));
  }
}

TEST_CASE("constant: a constant picture of any small size is unchanged") {
  for (int height : {1, 2, 3, 5, 8, 17}) {
    for (int width : {1, 2, 3, 4, 7, 16, 31, 33}) {
      for (int views : test::kStars) {
        Trial t = {width, height, views, -3, 4, 0.25};
        t.seed = static_cast<uint64_t>(width * 100 + height);
        for (size_t c = 0; c < 3; ++c) t.color[c] = static_cast<uint8_t>(t.seed * (c + 7));
        CHECK_MESSAGE(Changed(t) == 0, Text(t));
      }
    }
  }
}

// Tests a wide lens with few views. If subapertures are wider than three pixels, slices are spread
// in separate memory. With N = 4, subapertures extend beyond the blur radius.
TEST_CASE("constant: with wide subapertures, a constant picture is unchanged") {
  Trial t = {64, 64, 1};
  t.levels = 6;
  t.renderer = STARFOCUS_RENDERER_SLICES;
  t.color.fill(204);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
    for (const double n_scale : {0.5, 0.66, 0.8, 2.0}) {
      for (int radius = 10; radius <= 50; radius += mode == STARFOCUS_MODE_FRAME ? 3 : 10) {
        t.mode = mode;
        t.n_scale = n_scale;
        t.max_blur = radius;
        t.low = static_cast<float>(-radius);
        t.high = static_cast<float>(radius);
        t.block = radius % 2 == 0 ? 64 : 32;
        t.seed = static_cast<uint64_t>(radius);
        CHECK_MESSAGE(Changed(t) == 0, Text(t));
      }
    }
  }
}

// If an opening is much brighter in the middle, most views have small weights, and dark codes are
// few levels of light. The engine therefore scales the weights up and adds the products in several
// parts. Slices that cover parts of a pixel still cause a rounding error. The rounding of partial
// coverage affects up to three pixels of a few pictures. In thin structures, it affects more
// pixels, because most views show parts of several surfaces there.
TEST_CASE(
    "constant: openings with a steep fall-off hardly change constant pictures of dark codes") {
  Trial t = {64, 64, 5};
  t.levels = 5;
  t.renderer = STARFOCUS_RENDERER_SLICES;
  int pictures = 0;  // pictures with a changed pixel
  for (const double part : {0.3, 0.35, 0.4, 0.42, 0.44, 0.45}) {
    for (const double radius : {1.5, 3.0, 4.0, 6.0, 8.0, 12.0}) {
      for (int code = 1; code < 40; ++code) {
        t.theta = std::min(part * 3.141592653589793, STARFOCUS_MAX_THETA);
        t.max_blur = radius;
        t.low = static_cast<float>(-radius);
        t.high = static_cast<float>(radius);
        t.mode = code % 2 == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_FRAME;
        t.seed = static_cast<uint64_t>(code);
        t.color.fill(static_cast<uint8_t>(code));
        t.splits_thin = true;
        CHECK_MESSAGE(Changed(t, 1) == 0, Text(t) << " thin, code " << code);
        t.splits_thin = false;
        const int changed = Changed(t);
        CHECK_MESSAGE(changed <= 9, Text(t) << " code " << code);
        pictures += changed > 0;
      }
    }
  }
  CHECK(pictures <= 2);
}

TEST_CASE("constant: for random configurations and lenses, a constant picture is unchanged") {
  test::Random random(2024);
  constexpr int kBlocks[] = {32, 64, 128, 256};
  // Number of pictures with a changed pixel. A pixel may change, since coverage is rounded to 15
  // bits.
  int pictures = 0;
  for (int round = 0; round < 250; ++round) {
    Trial t;
    t.width = random.Int(1, 90);
    t.height = random.Int(1, 70);
    t.views = test::kStars[random.Int(0, 3)];
    t.block = kBlocks[random.Int(0, 3)];
    const double middle = random.Real(-20, 20), spread = random.Real(0, 6);
    t.low = static_cast<float>(middle - spread);
    t.high = static_cast<float>(middle + spread);
    t.focus = middle + random.Real(-1, 1) * (random.Int(0, 3) ? 3 : 10);
    t.aperture = random.Int(0, 2) ? random.Real(0.01, 1) : 1;
    t.mode = random.Int(0, 3) ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BENCHMARK;
    t.noisy = random.Int(0, 1) == 1;
    for (uint8_t& c : t.color) c = random.Byte();
    t.seed = static_cast<uint64_t>(round) + 1000;
    const int changed = Changed(t);
    CHECK_MESSAGE((changed == 0 || (changed == 1 && t.noisy)), Text(t));
    pictures += changed > 0;
  }
  CHECK(pictures <= 1);
}

}  // namespace
}  // namespace constant_slow_test
