// SPDX-License-Identifier: Apache-2.0
// Tests that an opaque surface with varying disparities lets no light through. The slices of such a
// surface move apart, but no gap between the slices may show the background.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "starfocus/starfocus.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace closed_test {
namespace {

// Side of the square picture; the surface covers the columns and rows from kFirst to kLast - 1.
constexpr int kSide = 160, kFirst = 40, kLast = 120;

// Returns a dark square of one colour in front of a bright wall.
test::Scene Square(int views, double jitter, double slope, uint64_t seed) {
  test::Scene scene = test::EmptyScene(kSide, kSide, views, -6, 8);
  test::Random random(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool near = x >= kFirst && x < kLast && y >= kFirst && y < kLast;
      const double disparity = 2 + slope * (x - kFirst) + random.Real(-jitter, jitter);
      scene.Disparity(x, y) = float(near ? disparity : -6);
      for (int view = 0; view < views; ++view) {
        std::fill_n(scene.Pixel(view, x, y), 3, near ? uint8_t{40} : uint8_t{250});
      }
    }
  }
  return scene;
}

// Returns the largest difference from the colour of the surface, in the area that the blur of other
// colours does not reach.
int MostLeaked(const test::Output& out, int blur) {
  int most = 0;
  for (int y = kFirst + blur; y < kLast - blur; ++y) {
    for (int x = kFirst + blur; x < kLast - blur; ++x) {
      most = std::max(most, std::abs(out.Pixel(x, y)[1] - 40));
    }
  }
  return most;
}

}  // namespace

TEST_CASE("closed: a surface with noisy or sloping disparities lets no light through") {
  for (const double jitter : {0.05, 0.12, 0.24}) {
    for (const double slope : {0.0, 0.02}) {
      for (const int views : {1, 5}) {
        const test::Scene scene = Square(views, jitter, slope, 3);
        const starfocus_config config = test::ConfigFor(scene, 16);
        test::Engine engine(config);
        for (const double focus : {-6.0, -2.0, 5.0, 9.0}) {
          for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
            CAPTURES(jitter, slope, views, focus, mode);
            starfocus_params params = test::Params(focus, 1, mode, STARFOCUS_RENDERER_SLICES);
            const test::Output out = test::OutputOf(&engine, params, scene);
            CHECK(MostLeaked(out, 16) <= 1);
          }
        }
      }
    }
  }
}

}  // namespace closed_test
