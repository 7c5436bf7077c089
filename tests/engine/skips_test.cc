// SPDX-License-Identifier: Apache-2.0
// What starfocus_skipped counts: the same bytes as with starfocus_tuning.skips = 0, on scenes where
// each of it is skipped, and nothing where it may not be.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "lib/base/view_weights.h"
#include "starfocus/starfocus.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace skips_test {
namespace {

using test::Refocused;

constexpr int kViews[] = {1, 5, 9, 17};
constexpr int kBlocks[] = {32, 64, 128, 256};
constexpr starfocus_mode kModes[] = {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK,
                                     STARFOCUS_MODE_BLOCK};

Refocused Refocus(const test::Scene& scene, starfocus_config config, const starfocus_params& params,
                  int skips) {
  config.tuning.skips = skips;
  return test::RefocusScene(scene, config, params);
}

void Add(const starfocus_skipped& part, starfocus_skipped* sum) {
  sum->copied_blocks += part.copied_blocks;
  sum->copied_pixels += part.copied_pixels;
  sum->layer_columns += part.layer_columns;
}

bool IsNothing(const starfocus_skipped& skipped) {
  return skipped.copied_blocks + skipped.copied_pixels + skipped.layer_columns == 0;
}

// Noise in every view; the disparity map has areas in focus, flat, gently and steeply slanted ones,
// and edges.
test::Scene VariedScene(int width, int height, int views, float limit, test::Random* random) {
  test::Scene scene = test::EmptyScene(width, height, views, -limit, limit);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), random);
  const auto rectangle = [&](const auto& put) {
    const bool large = random->Int(0, 1) == 1;
    const int x0 = large ? 0 : random->Int(0, width - 1), y0 = random->Int(0, height - 1);
    const int x1 = std::min(width, x0 + random->Int(1, width)), y1 = large ? height : y0 + 40;
    for (int y = y0; y < std::min(y1, height); ++y) {
      for (int x = x0; x < x1; ++x) put(x, y);
    }
  };
  for (int piece = random->Int(0, 5); piece >= 0; --piece) {
    constexpr double kSlopes[] = {0, 0, 0.02, 0.12, 0.13, 0.9, 1.6};
    const double base = random->Int(0, 2) == 0 ? 0 : random->Real(-limit, limit);
    const double slope = kSlopes[random->Int(0, 6)];
    const int along_x = random->Int(0, 1);
    const auto put = [&](int x, int y) {
      const double d = base + slope * (along_x == 1 ? x : y);
      scene.Disparity(x, y) = std::clamp(float(d), -limit, limit);
    };
    if (piece > 0) {
      rectangle(put);
      continue;
    }
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) put(x, y);
    }
  }
  return scene;
}

TEST_CASE("skips: the same bytes as with all the work done, in every mode") {
  test::Random random(51);
  starfocus_skipped sum = {};
  for (int round = 0; round < test::Rounds(400); ++round) {
    const float limit = float(random.Int(1, 6));
    const int width = random.Int(1, 200), height = random.Int(1, 120);
    const int views = kViews[random.Int(0, 3)];
    const test::Scene scene = VariedScene(width, height, views, limit, &random);
    starfocus_config config = test::ConfigFor(scene, 20);
    config.superblock = kBlocks[random.Int(0, 3)];
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    if (random.Int(0, 3) == 0) config.tuning.n_scale = random.Real(0.5, 2);
    config.tuning.gather = random.Int(0, 1);
    const starfocus_mode mode = kModes[round % 3 == 0 ? round / 3 % 2 : 2];
    const double focus = random.Int(0, 1) == 0 ? 0 : random.Real(-2 * limit, 2 * limit);
    double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.02, 1);
    if (mode == STARFOCUS_MODE_BENCHMARK) aperture /= limit;
    starfocus_params params = test::Params(focus, aperture, mode);
    params.renderer = random.Int(0, 2);
    const Refocused skipped = Refocus(scene, config, params, 1);
    const Refocused whole = Refocus(scene, config, params, 0);
    CAPTURE(round);
    CAPTURE(mode);
    const bool same = skipped.rgb == whole.rgb;
    CHECK(same);
    CHECK(IsNothing(whole.report.skipped));
    CHECK(skipped.report.side_bytes <= whole.report.side_bytes);
    CHECK(skipped.report.rendered_samples <= whole.report.rendered_samples);
    Add(skipped.report.skipped, &sum);
  }
  char text[200];
  std::snprintf(text, sizeof(text), "%d copied, %d layer columns", int(sum.copied_blocks),
                int(sum.layer_columns));
  MESSAGE(std::string(text));
  constexpr unsigned kSome = STARFOCUS_EMULATED ? 20 : 100;
  CHECK(sum.copied_blocks > kSome);
  CHECK(sum.copied_pixels > kSome * 256);
  CHECK(sum.layer_columns > kSome);
}

// Noise at disparity 0 with a column of `other` at x.
test::Scene ColumnScene(int width, int height, int x, float other) {
  test::Random random(7);
  test::Scene scene = test::EmptyScene(width, height, 5, -8, 8);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), &random);
  for (int y = 0; y < height; ++y) {
    for (int k = 0; k < width; ++k) scene.Disparity(k, y) = k == x ? other : 0;
  }
  return scene;
}

TEST_CASE("skips: in frame modes a block in focus is copied, but for what splats into it") {
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
    test::Scene scene = ColumnScene(256, 64, 250, 8);
    starfocus_params params = test::Params(0, 1, mode);
    params.renderer = STARFOCUS_RENDERER_LINE_SCAN;
    const starfocus_config config = test::ConfigFor(scene, 8);
    const Refocused picture = Refocus(scene, config, params, 1);
    CHECK(picture.report.skipped.copied_blocks == 3);
    CHECK(picture.report.skipped.copied_pixels == 3 * 64 * 64);
    CHECK(picture.report.layers[0].views == 3 + uint64_t(picture.report.rendered_views));
    // 8 pixels beyond the third block's edge, and no more.
    scene = ColumnScene(256, 64, 192 + 7, 8);
    CHECK(Refocus(scene, config, params, 1).report.skipped.copied_blocks == 2);
  }
}

TEST_CASE("skips: with N by (9) shifts of up to a third of a pixel move nothing, above they do") {
  for (const double radius : {0.1, 0.32, 0.36, 0.4}) {
    const test::Scene scene = test::RandomScene(64, 64, 5, 1, 1, 3);
    starfocus_params params = test::Params(1 - radius, 1, STARFOCUS_MODE_BLOCK);
    params.renderer = STARFOCUS_RENDERER_LINE_SCAN;
    const starfocus_config config = test::ConfigFor(scene, 8);
    const Refocused skipped = Refocus(scene, config, params, 1);
    const bool copied = skipped.report.skipped.copied_pixels == 64 * 64;
    const bool centre = Refocus(scene, config, params, 0).rgb == scene.pictures[0];
    CAPTURE(radius);
    CHECK(copied == (radius < 1.0 / 3));
    CHECK(centre == (radius < 1.0 / 3 + 0.01));
  }
}

// Noise at disparity 2.
test::Scene FlatScene() {
  test::Random random(8);
  test::Scene scene = test::EmptyScene(192, 64, 5, -8, 8);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), &random);
  std::fill(scene.disparity.begin(), scene.disparity.end(), 2.0F);
  return scene;
}

TEST_CASE("skips: levels that no block reads are not made") {
  const test::Scene scene = FlatScene();
  starfocus_config config = test::ConfigFor(scene, 40);
  starfocus_params params = test::Params(2.25, 1, STARFOCUS_MODE_BLOCK);  // blur radius 0.25
  const starfocus_skipped focused = Refocus(scene, config, params, 1).report.skipped;
  CHECK(focused.layer_columns == 2 * 3);
  params.lens.focus = 27;  // 25: all at layer 2, and no block reads layer 1
  const starfocus_skipped far = Refocus(scene, config, params, 1).report.skipped;
  CHECK(far.layer_columns == 3);
  config.tuning.max_layer = 1;
  CHECK(Refocus(scene, config, params, 1).report.skipped.layer_columns == 0);
}

TEST_CASE("skips: no view of an aperture has weight zero, so that there is none to leave out") {
  // Beyond these N the rim has some, beside views that weigh little more: weights sum to 17 bits.
  struct Lens {
    double theta;
    int most;
  };
  for (const auto [theta, most] :
       {Lens{STARFOCUS_MIN_THETA, 146}, Lens{0.26 * 3.14159265358979, 117},
        Lens{STARFOCUS_MAX_THETA, 31}}) {
    for (int n = 0; n <= most; ++n) {
      std::vector<uint16_t> weights(starfocus::ViewWeightsSize(n));
      const starfocus::ViewWeights aperture =
          starfocus::MakeViewWeights(n, starfocus::ApertureFallOff(theta), weights.data());
      int zero = 0;
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= i; ++j) zero += i * i + j * j <= n * n && aperture.Weight(i, j) == 0;
      }
      CAPTURE(theta);
      CAPTURE(n);
      CHECK(zero == 0);
    }
  }
}

}  // namespace
}  // namespace skips_test
