// SPDX-License-Identifier: Apache-2.0
// Tests highlights: clipped lamps must regain their brightness, and white walls must not become
// brighter. Tests that maps with unknown values are either rejected or filled along rows.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/transfer_curve.h"

namespace input_test {
namespace {

constexpr int kSide = 120;

// Returns a dark flat picture with a white rectangle.
test::Scene WhiteRect(int x0, int y0, int width, int height, int code = 255, int views = 1) {
  test::Scene scene = test::EmptyScene(kSide, kSide, views, 0, 0);
  for (int view = 0; view < views; ++view) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool lit = x >= x0 && x < x0 + width && y >= y0 && y < y0 + height;
        std::fill_n(scene.Pixel(view, x, y), 3, uint8_t(lit ? code : 20));
      }
    }
  }
  return scene;
}

std::vector<uint8_t> Picture(const test::Scene& scene, double blur, double highlights,
                             starfocus_mode mode = STARFOCUS_MODE_BLOCK) {
  test::Config config = test::ConfigFor(scene, 20);
  config.superblock = 32;
  // The test disables layers 1 and 2 and the blurring of cells without views, which the engine does
  // not use near highlights.
  config.tuning.max_layer = config.tuning.gather = 0;
  config.highlights = float(highlights);
  starfocus::Params params = test::Params(blur, 1, mode);
  return test::RefocusScene(scene, config, params).rgb;
}

// Returns the sum of the light of all red samples.
double LightIn(const std::vector<uint8_t>& picture) {
  double sum = 0;
  for (size_t i = 0; i < picture.size(); i += 3) {
    sum += test::LightOf(picture[i], STARFOCUS_TRANSFER_SRGB);
  }
  return sum;
}

TEST_CASE(
    "highlights: codes from 251 are brightened, most of all 255, and lower codes are unchanged") {
  const auto light = [&](int code, double highlights) {
    return LightIn(Picture(WhiteRect(58, 58, 4, 4, code), 10, highlights));
  };
  double before = 0;
  for (int code = 249; code <= 255; ++code) {
    const double more = light(code, 4) - light(code, 1);
    CAPTURE(code);
    if (code < 251) {
      CHECK(more == 0);
    } else {
      CHECK(more > before);
    }
    before = more;
  }
  // A pixel with one clipped channel is a saturated colour, not a lamp.
  test::Scene red = WhiteRect(58, 58, 4, 4, 255);
  for (int y = 58; y < 62; ++y) {
    for (int x = 58; x < 62; ++x) red.Pixel(0, x, y)[1] = red.Pixel(0, x, y)[2] = 200;
  }
  CHECK((Picture(red, 10, 8) == Picture(red, 10, 1)));
}

TEST_CASE("highlights: white areas larger than lamps are not brightened") {
  struct Wall {
    int x, y, width, height;
  };
  // Each wall is either larger than twice the size of the largest lamp (16 pixels in this test), or
  // only partly visible.
  for (const Wall& wall : {Wall{30, 40, 34, 33}, Wall{0, 0, 50, kSide}, Wall{0, 100, kSide, 20}}) {
    const test::Scene scene = WhiteRect(wall.x, wall.y, wall.width, wall.height);
    for (const double blur : {0.0, 3.0, 11.0}) {
      CAPTURES(wall.x, blur);
      const std::vector<uint8_t> plain = Picture(scene, blur, 1), bright = Picture(scene, blur, 16);
      int most = 0;
      for (size_t i = 0; i < plain.size(); ++i) {
        most = std::max(most, std::abs(int(plain[i]) - int(bright[i])));
      }
      CHECK(most <= 1);  // Blocks with highlights are rendered from views only.
    }
  }
  // A white area that is long in only one direction, such as a fluorescent tube, counts as a lamp.
  const test::Scene tube = WhiteRect(20, 60, 80, 4);
  CHECK(LightIn(Picture(tube, 11, 4)) > 2 * LightIn(Picture(tube, 11, 1)));
}

TEST_CASE("highlights: for a white picture, the excess of highlights is not rendered") {
  const auto samples = [](const test::Scene& scene, double highlights) {
    test::Config config = test::ConfigFor(scene, 20);
    config.tuning.gather = 0;
    config.highlights = float(highlights);
    return test::RefocusScene(scene, config, test::Params(9, 1, STARFOCUS_MODE_BLOCK))
        .report.rendered_samples;
  };
  for (const int views : {1, 5}) {
    CAPTURE(views);
    test::Scene white = WhiteRect(0, 0, kSide, kSide, 255, views);
    CHECK(samples(white, 16) == samples(white, 1));
    std::fill_n(white.Pixel(views - 1, kSide / 2, kSide / 2), 2, uint8_t{20});
    CHECK(samples(white, 16) > samples(white, 1));
  }
}

TEST_CASE("highlights: neither a picture without highlights nor a factor of 1 changes any byte") {
  for (const int views : {1, 5, 17}) {
    test::Scene scene = test::RandomScene(70, 60, views, -4, 4, 77);
    for (auto& picture : scene.pictures) {
      for (uint8_t& sample : picture) sample = std::min(sample, uint8_t(250));
    }
    for (const starfocus_mode mode : test::kModes) {
      CAPTURES(views, mode);
      CHECK((Picture(scene, 3, 64, mode) == Picture(scene, 3, 1, mode)));
    }
  }
  // A factor that rounds to 1 changes no byte of a picture with highlights.
  const test::Scene lamp = WhiteRect(58, 59, 3, 3);
  for (const starfocus_mode mode : test::kModes) {
    CAPTURE(mode);
    CHECK((Picture(lamp, 11, 1.001, mode) == Picture(lamp, 11, 1, mode)));
  }
}

// --- Unknown values of maps ---

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A scene with partly unknown disparities, and this scene with the expected filled disparities.
struct Scenes {
  test::Scene unknown, filled;
  int64_t count = 0;

  Scenes(int width, int height, int views, uint64_t seed)
      : unknown(test::RandomScene(width, height, views, -3, 3, seed)), filled(unknown) {}

  // Makes the disparities of columns [first, end) of row y unknown. The expected filled disparity
  // is `value`.
  void Forget(int y, int first, int end, float value, float as = kNaN) {
    for (int x = first; x < end; ++x) {
      unknown.Disparity(x, y) = as;
      filled.Disparity(x, y) = value;
    }
    count += end - first;
  }
};

// Makes gaps at both ends, gaps in the middle with the farther surface on either side, and an
// unknown row.
Scenes WithGaps(int views) {
  Scenes scenes(150, 90, views, 5);
  for (int y = 3; y < 90; y += 7) {
    const auto at = [&](int x) { return scenes.filled.Disparity(x, y); };
    scenes.Forget(y, 0, 9, at(9));
    scenes.Forget(y, 40, 63, std::min(at(39), at(63)), y % 2 == 0 ? kInfinity : -kInfinity);
    scenes.Forget(y, 141, 150, at(140));
  }
  scenes.Forget(50, 0, 150, scenes.unknown.disparity_min);
  return scenes;
}

test::Config FillingConfig(const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene, 32);
  config.unknown = STARFOCUS_UNKNOWN_FILL;
  return config;
}

TEST_CASE("fill unknown: in every mode, gaps get the farther known value of the row") {
  for (const int views : {1, 5}) {
    const Scenes scenes = WithGaps(views);
    for (const starfocus_mode mode : test::kModes) {
      const starfocus::Params params = test::Params(0.5, 0.5, mode);
      const test::Refocused filled =
          test::RefocusScene(scenes.unknown, FillingConfig(scenes.unknown), params);
      const test::Refocused by_hand =
          test::RefocusScene(scenes.filled, test::ConfigFor(scenes.filled, 32), params);
      CAPTURES(views, mode);
      CHECK(filled.rgb == by_hand.rgb);
      CHECK(filled.report.unknown_pixels == uint64_t(scenes.count));
      CHECK(by_hand.report.unknown_pixels == 0);
    }
  }
}

TEST_CASE(
    "fill unknown: values out of range, and unknown values without the option, are rejected") {
  Scenes scenes = WithGaps(1);
  const auto status = [&](const test::Config& config) {
    test::Engine engine(config);
    test::Output out(scenes.unknown.width, scenes.unknown.height);
    const starfocus::Params params = test::Params(0, 0.5, STARFOCUS_MODE_BLOCK);
    const starfocus_status found = test::Refocus(&engine, params, scenes.unknown, &out);
    CHECK(out.Untouched());
    return found;
  };
  CHECK(status(test::ConfigFor(scenes.unknown, 32)) == STARFOCUS_ERROR_NOT_FINITE);
  // The rejected value lies next to unknown values.
  scenes.unknown.Disparity(70, 10) = scenes.unknown.disparity_max + 1;
  CHECK(status(FillingConfig(scenes.unknown)) == STARFOCUS_ERROR_DISPARITY);
}

}  // namespace
}  // namespace input_test
