// SPDX-License-Identifier: Apache-2.0
// What sf_skipped counts: the same bytes as with sf_config.skips = 0, on scenes where each of it is
// skipped, and nothing where it may not be.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "lib/base/aperture.h"
#include "starfocus/starfocus.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace {

using test::Refocused;

constexpr int kViews[] = {1, 5, 9, 17};
constexpr int kBlocks[] = {32, 64, 128, 256};
constexpr sf_mode kModes[] = {SF_MODE_FRAME, SF_MODE_BENCHMARK, SF_MODE_BLOCK};

Refocused Refocus(const test::Scene& scene, sf_config config, const sf_params& params, int skips) {
  config.skips = skips;
  return test::RefocusScene(scene, config, params);
}

void Add(const sf_skipped& part, sf_skipped* sum) {
  sum->copied_blocks += part.copied_blocks;
  sum->copied_pixels += part.copied_pixels;
  sum->filled_blocks += part.filled_blocks;
  sum->filled_pixels += part.filled_pixels;
  sum->layer_columns += part.layer_columns;
  sum->boundaries += part.boundaries;
}

bool IsNothing(const sf_skipped& skipped) {
  return skipped.copied_blocks + skipped.copied_pixels + skipped.filled_blocks +
             skipped.filled_pixels + skipped.layer_columns + skipped.boundaries ==
         0;
}

// Noise in every view; the centre view has areas of one colour, the disparity map areas in focus,
// flat, gently and steeply slanted ones, and edges.
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
  for (int piece = random->Int(0, 6); piece > 0; --piece) {
    const uint8_t colour[3] = {random->Byte(), random->Byte(), random->Byte()};
    rectangle([&](int x, int y) { std::copy_n(colour, 3, scene.Pixel(0, x, y)); });
  }
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
  sf_skipped sum = {};
  for (int round = 0; round < test::Rounds(400); ++round) {
    const float limit = float(random.Int(1, 6));
    const int width = random.Int(1, 200), height = random.Int(1, 120);
    const int views = kViews[random.Int(0, 3)];
    const test::Scene scene = VariedScene(width, height, views, limit, &random);
    sf_config config = test::ConfigFor(scene, 20);
    config.largest_block = kBlocks[random.Int(0, 3)];
    config.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    if (random.Int(0, 3) == 0) config.n_scale = random.Real(0.5, 2);
    config.gather = random.Int(0, 1);
    const sf_mode mode = kModes[round % 3 == 0 ? round / 3 % 2 : 2];
    const double focus = random.Int(0, 1) == 0 ? 0 : random.Real(-2 * limit, 2 * limit);
    double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.02, 1);
    if (mode == SF_MODE_BENCHMARK) aperture /= limit;
    sf_params params = test::Params(focus, aperture, mode);
    params.rule = random.Int(0, 2);
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
  std::snprintf(text, sizeof(text), "%d copied, %d filled, %d layer columns, %d boundaries",
                int(sum.copied_blocks), int(sum.filled_blocks), int(sum.layer_columns),
                int(sum.boundaries));
  MESSAGE(std::string(text));
  constexpr unsigned kSome = STARFOCUS_EMULATED ? 20 : 100, kFew = STARFOCUS_EMULATED ? 4 : 20;
  CHECK(sum.copied_blocks > kSome);
  CHECK(sum.filled_blocks > kFew);
  CHECK(sum.copied_pixels > kSome * 256);
  CHECK(sum.filled_pixels > kFew * 256);
  CHECK(sum.layer_columns > kSome);
  CHECK(sum.boundaries > kSome);
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
  for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK}) {
    test::Scene scene = ColumnScene(256, 64, 250, 8);
    sf_params params = test::Params(0, 1, mode);
    params.rule = SF_RULE_PAPER;
    const sf_config config = test::ConfigFor(scene, 8);
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
    sf_params params = test::Params(1 - radius, 1, SF_MODE_BLOCK);
    params.rule = SF_RULE_PAPER;
    const sf_config config = test::ConfigFor(scene, 8);
    const Refocused skipped = Refocus(scene, config, params, 1);
    const bool copied = skipped.report.skipped.copied_pixels == 64 * 64;
    const bool centre = Refocus(scene, config, params, 0).rgb == scene.pictures[0];
    CAPTURE(radius);
    CHECK(copied == (radius < 1.0 / 3));
    CHECK(centre == (radius < 1.0 / 3 + 0.01));
  }
}

// One colour in the centre view, another in the side views but where they look beyond the picture,
// and an edge or a slope.
test::Scene OneColourScene(int views, int edge, float step) {
  test::Scene scene = test::EmptyScene(192, 64, views, -8, 8);
  for (size_t view = 0; view < scene.pictures.size(); ++view) {
    std::fill(scene.pictures[view].begin(), scene.pictures[view].end(), uint8_t{40});
    for (int y = 9; y < scene.height - 9 && view > 0; ++y) {
      for (int x = 9; x < scene.width - 9; ++x) {
        std::fill_n(scene.Pixel(int(view), x, y), 3, uint8_t{200});
      }
    }
  }
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      scene.Disparity(x, y) =
          std::clamp(x < edge ? 2 : 2 + step * float(x - edge + 1), -8.0f, 8.0f);
    }
  }
  return scene;
}

bool HasOtherColour(const Refocused& picture) {
  return std::any_of(picture.rgb.begin(), picture.rgb.end(), [](uint8_t b) { return b != 40; });
}

TEST_CASE("skips: blocks of one colour are filled, but not where side views show another") {
  struct {
    int views;
    float step;
    uint64_t filled;
  } constexpr kCases[] = {{17, 0, 3}, {5, 0.05f, 3}, {5, 0.3f, 2}, {5, 6, 2}, {1, 6, 3}};
  for (const auto& one : kCases) {
    const test::Scene scene = OneColourScene(one.views, 90, one.step);
    sf_config config = test::ConfigFor(scene, 12);
    config.timing.block = SF_MAX_TIMING;  // whole blocks
    config.gather = 0;
    CAPTURE(one.views);
    CAPTURE(one.step);
    for (const sf_mode mode : kModes) {
      const sf_params params = test::Params(-1, 1, mode);
      const Refocused picture = Refocus(scene, config, params, 1);
      CAPTURE(mode);
      const uint64_t blocks = mode == SF_MODE_BENCHMARK ? 4 * one.filled : one.filled;  // of 32
      if (mode != SF_MODE_BLOCK) CHECK(picture.report.skipped.filled_blocks == blocks);
      CHECK(picture.report.skipped.filled_pixels >= 64 * 64);
      const bool same = picture.rgb == Refocus(scene, config, params, 0).rgb;
      CHECK(same);
      const bool side = one.views > 1 && one.step == 6;
      if (side) CHECK(picture.report.side_bytes > 0);
      CHECK(HasOtherColour(picture) == side);
    }
  }
}

TEST_CASE("skips: the steepest surface that counts as without holes has none") {
  test::Random random(52);
  for (int round = 0; round < test::Rounds(60); ++round) {
    test::Scene scene = OneColourScene(kViews[1 + round % 3], 192, 0);
    // A walk of eighths along either axis, now and then in one direction for long.
    std::vector<float> across(size_t(scene.width)), down(size_t(scene.height));
    for (std::vector<float>* walk : {&across, &down}) {
      const int turn = random.Int(1, 40);
      float step = 0.125f, at = 0;
      for (float& value : *walk) {
        if (random.Int(0, turn) == 0) step = -step;
        at = std::clamp(at + step, -4.0f, 4.0f);
        value = at;
      }
    }
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        scene.Disparity(x, y) = across[size_t(x)] + down[size_t(y)];
      }
    }
    sf_config config = test::ConfigFor(scene, 26);
    config.n_scale = random.Real(0.5, 2);
    const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(0.1, 1);
    sf_params params = test::Params(random.Real(-18, 18), aperture,
                                    round % 2 == 0 ? SF_MODE_FRAME : SF_MODE_BLOCK);
    params.rule = random.Int(0, 2);
    const Refocused picture = Refocus(scene, config, params, 1);
    CAPTURE(round);
    // Layers take every second or fourth disparity, whose steps are larger.
    if (params.mode == SF_MODE_FRAME) CHECK(picture.report.skipped.filled_pixels == 192 * 64);
    const Refocused whole = Refocus(scene, config, params, 0);
    const bool same = picture.rgb == whole.rgb;
    CHECK(same);
    if (params.mode == SF_MODE_FRAME) CHECK(!HasOtherColour(whole));
  }
}

TEST_CASE("skips: one pixel of another colour within reach is enough") {
  test::Scene scene = OneColourScene(5, 192, 0);  // blur radius 3 at focus -1
  sf_config config = test::ConfigFor(scene, 12);
  config.timing.block = SF_MAX_TIMING;  // whole blocks
  config.gather = 0;
  config.max_layer = 0;  // layer 1 rounds a step of one level away
  for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BLOCK}) {
    const sf_params params = test::Params(-1, 1, mode);
    for (const int x : {62, 66}) {
      test::Scene spotted = scene;
      spotted.Pixel(0, x, 30)[1] = 41;
      CHECK(Refocus(spotted, config, params, 1).report.skipped.filled_pixels == 64 * 64);
    }
  }
}

TEST_CASE("skips: another colour that side views see beyond the picture is enough") {
  const test::Scene scene = OneColourScene(5, 192, 0);
  sf_config config = test::ConfigFor(scene, 12);
  config.gather = 0;
  const auto filled = [&](const test::Scene& shown, sf_mode mode) {
    const sf_params params = test::Params(-1, 1, mode);
    const Refocused picture = Refocus(shown, config, params, 1);
    const bool same = picture.rgb == Refocus(shown, config, params, 0).rgb;
    CHECK(same);
    return picture.report.skipped.filled_pixels;
  };
  test::Scene spotted = scene;
  spotted.Pixel(2, 1, 30)[2] = 41;  // seen a pixel beyond the left edge
  for (const sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK, SF_MODE_BLOCK}) {
    CHECK(filled(scene, mode) == 192 * 64);
    CHECK(filled(spotted, mode) < 192 * 64);
  }
}

TEST_CASE("skips: layers that no block reads and joins that there are not") {
  const test::Scene scene = OneColourScene(5, 192, 0);
  sf_config config = test::ConfigFor(scene, 40);
  sf_params params = test::Params(2.25, 1, SF_MODE_BLOCK);  // blur radius 0.25
  const sf_skipped focused = Refocus(scene, config, params, 1).report.skipped;
  CHECK(focused.layer_columns == 2 * 3);
  CHECK(focused.boundaries == 4 * 11 + 3 * 12);
  params.focus = 27;  // 25: all at layer 2, and no block reads layer 1
  const sf_skipped far = Refocus(scene, config, params, 1).report.skipped;
  CHECK(far.layer_columns == 3);
  CHECK(far.boundaries == 4 * 11 + 3 * 12);
  config.max_layer = 1;
  CHECK(Refocus(scene, config, params, 1).report.skipped.layer_columns == 0);
  config.largest_block = 32;  // two stripes of two rows of units
  CHECK(Refocus(scene, config, params, 1).report.skipped.boundaries == 4 * 11 + 3 * 12);
}

TEST_CASE("skips: no view of an aperture has weight zero, so that there is none to leave out") {
  // Beyond these N the rim has some, beside views that weigh little more: weights sum to 17 bits.
  struct Lens {
    double theta;
    int most;
  };
  for (const auto [theta, most] :
       {Lens{SF_MIN_THETA, 146}, Lens{0.26 * 3.14159265358979, 117}, Lens{SF_MAX_THETA, 31}}) {
    for (int n = 0; n <= most; ++n) {
      std::vector<uint16_t> weights(starfocus::ApertureSize(n));
      const starfocus::Aperture aperture =
          starfocus::MakeAperture(n, starfocus::ApertureFallOff(theta), weights.data());
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
