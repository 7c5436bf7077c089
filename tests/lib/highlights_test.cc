// SPDX-License-Identifier: Apache-2.0
// Tests highlights: clipped lamps must regain their brightness, and white walls must not become
// brighter.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/transfer_curve.h"

namespace highlights_test {
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

}  // namespace
}  // namespace highlights_test
