// SPDX-License-Identifier: Apache-2.0
// Tests that an opaque surface with varying disparities lets no light through. The slices of such a
// surface move apart, but no gap between the slices may show the background.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace closed_test {
namespace {

// Side of the square picture; the surface covers the columns and rows from kFirst to kLast - 1.
constexpr int kSide = 160, kFirst = 40, kLast = 120;
// Length in pixels of the hairs above the surface.
constexpr int kHair = 10;

// Green of the surface and of the wall behind it. Light of the wall raises the surface's green.
constexpr uint8_t kSurfaceGreen = 40, kWallGreen = 250;

enum class Outline {
  kSharp,  // a square
  kHairy,  // a square with hairs, whose coverage is found
  kGiven   // a square with hairs, whose coverage is given
};

struct Surface {
  double jitter, slope;  // of the disparities, in pixels and in pixels per column
  Outline outline;
};

// Returns the share of a pixel that the surface covers. Every other column above the surface is a
// hair, and the columns between hairs are covered in part.
double CoverageAt(int x, int y, Outline outline) {
  if (x < kFirst || x >= kLast || y < kFirst - kHair || y >= kLast) return 0;
  if (y >= kFirst) return 1;
  if (outline == Outline::kSharp) return 0;
  return x % 2 == 0 ? 0.7 : 0.3;
}

// Returns a surface of random red and constant green in front of a wall.
test::Scene Before(const Surface& surface, int views, uint64_t seed) {
  test::Scene scene = test::EmptyScene(kSide, kSide, views, -6, 8);
  test::Random random(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double coverage = CoverageAt(x, y, surface.outline);
      const double disparity =
          2 + surface.slope * (x - kFirst) + random.Real(-surface.jitter, surface.jitter);
      const auto mixed = [&](double near, double far) {
        return uint8_t(coverage * near + (1 - coverage) * far + 0.5);
      };
      scene.Disparity(x, y) = float(coverage > 0.5 ? disparity : -6);
      const uint8_t red = mixed(random.Real(0, 255), 250);
      for (int view = 0; view < views; ++view) {
        uint8_t* const pixel = scene.Pixel(view, x, y);
        pixel[0] = red;
        pixel[1] = mixed(kSurfaceGreen, kWallGreen);
        pixel[2] = mixed(40, 250);
      }
      if (surface.outline == Outline::kGiven) scene.coverage.push_back(mixed(255, 0));
    }
  }
  return scene;
}

// Returns the largest difference from the green of the surface in the area that the blur of other
// colours does not reach.
int MostLeaked(const test::Output& out, int blur) {
  int most = 0;
  for (int y = kFirst + blur; y < kLast - blur; ++y) {
    for (int x = kFirst + blur; x < kLast - blur; ++x) {
      most = std::max(most, std::abs(out.Pixel(x, y)[1] - kSurfaceGreen));
    }
  }
  return most;
}

}  // namespace

TEST_CASE("closed: a surface with noisy or sloping disparities lets no light through") {
  // Steps between neighbours are up to twice the jitter plus the slope: at most 3/4 pixel.
  int seed = 0;
  for (const double jitter : {0.05, 0.12, 0.24, 0.34}) {
    for (const double slope : {0.0, 0.02}) {
      for (const Outline outline : {Outline::kSharp, Outline::kHairy, Outline::kGiven}) {
        for (const int views : {1, 5}) {
          const test::Scene scene = Before({jitter, slope, outline}, views, uint64_t(++seed));
          test::Config config = test::ConfigFor(scene, 16);
          config.features |= STARFOCUS_FEATURE_COVERAGE;
          test::Engine engine(config);
          for (const double focus : {-6.0, -2.0, 2.5, 5.0, 9.0}) {
            for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
              CAPTURES(jitter, slope, int(outline), views, seed, focus, mode);
              starfocus::Params params = test::Params(focus, 1, mode, STARFOCUS_RENDERER_SLICES);
              const test::Output out = test::OutputOf(&engine, params, scene);
              const int blur = int(std::max(std::abs(focus - 2), std::abs(focus - 4))) + 9;
              CHECK(MostLeaked(out, blur) <= 1);
            }
          }
        }
      }
    }
  }
}

}  // namespace closed_test
