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
#include "tests/support/ways.h"

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
                             starfocus_mode mode = STARFOCUS_MODE_BLOCK,
                             starfocus_renderer renderer = STARFOCUS_RENDERER_AUTO,
                             starfocus_transfer transfer = STARFOCUS_TRANSFER_SRGB) {
  test::Config config = test::ConfigFor(scene, 20);
  config.superblock = 32;
  // The test disables layers 1 and 2 and the blurring of cells without views, which the engine does
  // not use near highlights.
  config.tuning.max_layer = config.tuning.gather = 0;
  config.highlights = float(highlights);
  config.transfer = transfer;
  starfocus::Params params = test::Params(blur, 1, mode, renderer);
  return test::RefocusScene(scene, config, params).rgb;
}

double LightIn(const std::vector<uint8_t>& picture, starfocus_transfer transfer) {
  double sum = 0;
  for (size_t i = 0; i < picture.size(); i += 3) sum += test::LightOf(picture[i], transfer);
  return sum;
}

TEST_CASE("highlights: the disc of a blurred lamp has all of the lamp's light") {
  const test::Scene lamp = WhiteRect(58, 59, 3, 3);
  for (const starfocus_transfer transfer : {STARFOCUS_TRANSFER_SRGB, STARFOCUS_TRANSFER_NONE}) {
    for (const starfocus_mode mode : test::kModes) {
      for (const starfocus_renderer renderer : test::kRenderers) {
        const auto light = [&](double highlights) {
          return LightIn(Picture(lamp, 11, highlights, mode, renderer, transfer), transfer);
        };
        CAPTURES(transfer, mode, renderer);
        const double clipped = light(1);
        CHECK(light(4) - clipped == doctest::Approx(9 * 3 * 255).epsilon(0.04));
        CHECK(light(8) - clipped == doctest::Approx(9 * 7 * 255).epsilon(0.04));
      }
    }
  }
}

TEST_CASE(
    "highlights: codes from 251 are brightened, most of all 255, and lower codes are unchanged") {
  const auto light = [&](int code, double highlights) {
    return LightIn(Picture(WhiteRect(58, 58, 4, 4, code), 10, highlights), STARFOCUS_TRANSFER_SRGB);
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

TEST_CASE("highlights: a factor that rounds to 1 changes no byte") {
  const test::Scene lamp = WhiteRect(58, 59, 3, 3);
  for (const starfocus_mode mode : test::kModes) {
    CAPTURE(mode);
    CHECK((Picture(lamp, 11, 1.001, mode) == Picture(lamp, 11, 1, mode)));
  }
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
  CHECK(LightIn(Picture(tube, 11, 4), STARFOCUS_TRANSFER_SRGB) >
        2 * LightIn(Picture(tube, 11, 1), STARFOCUS_TRANSFER_SRGB));
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

TEST_CASE("highlights: the factor changes no byte of a picture without highlights") {
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
}

TEST_CASE("highlights: all ways to refocus return the same bytes") {
  for (const int views : {1, 5}) {
    test::Scene scene = test::RandomScene(97, 150, views, -3, 5, 78);
    for (int lamp = 0; lamp < 12; ++lamp) {
      for (int view = 0; view < views; ++view) {
        for (int y = 12 * lamp; y < 12 * lamp + 2 + lamp; ++y) {
          std::fill_n(scene.Pixel(view, 5 + 6 * lamp, y), 3 * (1 + lamp % 4), uint8_t(255));
        }
      }
    }
    for (const starfocus_mode mode : test::kModes) {
      test::Config config = test::ConfigFor(scene, 9);
      config.superblock = 32;
      config.highlights = 6;
      const starfocus::Params params = test::Params(-4, 1, mode);
      CAPTURES(views, mode);
      test::CheckWays(scene, config, params);
    }
  }
}

}  // namespace
}  // namespace highlights_test
