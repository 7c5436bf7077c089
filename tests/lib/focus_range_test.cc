// SPDX-License-Identifier: Apache-2.0
// Tests lenses with a range in focus: surfaces inside the range are sharp, and other surfaces are
// blurred as by a lens that is focused at the adjacent end of the range.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace focus_range_test {
namespace {

constexpr int kSide = 96, kReach = 16;

// Returns parameters with the disparities from `far` to `near` in focus. `focus` lies inside.
starfocus::Params ParamsOf(double far, double focus, double near) {
  starfocus::Params params = test::Params(focus);
  params.focus_nearer = near - focus;
  params.focus_farther = focus - far;
  return params;
}

// Calls check(params) for every mode and renderer.
void ForModes(starfocus::Params params,
              const std::function<void(const starfocus::Params&)>& check) {
  for (const starfocus_mode mode : test::kModes) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      CAPTURES(mode, renderer);
      params.study.mode = mode;
      params.study.renderer = renderer;
      check(params);
    }
  }
}

// Returns the centre view in the form of a refocused picture.
std::vector<uint8_t> CentreOf(const test::Scene& scene) {
  std::vector<uint8_t> bytes;
  for (int y = 0; y < scene.height; ++y) {
    bytes.insert(bytes.end(), scene.Pixel(0, 0, y), scene.Pixel(0, 0, y) + 3 * scene.width);
  }
  return bytes;
}

// Returns a scene whose left half has random rectangles with disparities from -2 to 5, and whose
// right half is a wall at `wall`.
test::Scene RectanglesBesideWall(int views, float wall) {
  test::Scene scene =
      test::EmptyScene(kSide, kSide, views, std::min(wall, -2.0F), std::max(wall, 5.0F));
  test::Random random(uint64_t(views) + 40);
  for (auto& picture : scene.pictures) {
    std::generate(picture.begin(), picture.end(), [&] { return random.Byte(); });
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) scene.Disparity(x, y) = x < kSide / 2 ? -2 : wall;
  }
  for (int piece = 0; piece < 30; ++piece) {
    const int x0 = random.Int(0, kSide / 2 - 9), y0 = random.Int(0, kSide - 9);
    const float disparity = float(random.Real(-2, 5));
    for (int y = y0; y < y0 + 9; ++y) {
      for (int x = x0; x < x0 + 9; ++x) scene.Disparity(x, y) = disparity;
    }
  }
  return scene;
}

// Returns the largest difference between two pictures in the columns from `first` to `end` - 1.
int LargestDifference(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int first,
                      int end) {
  int largest = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int k = 3 * (y * kSide + first); k < 3 * (y * kSide + end); ++k) {
      largest = std::max(largest, std::abs(a[size_t(k)] - b[size_t(k)]));
    }
  }
  return largest;
}

}  // namespace

TEST_CASE("focus range: if all disparities are in focus, the picture is the centre view") {
  for (const int views : {1, 5, 17}) {
    const test::Scene scene = test::LayeredScene(kSide, kSide, views, 7, 3);
    test::Engine engine(test::ConfigFor(scene, 4));
    ForModes(ParamsOf(-7, 2, 7.5), [&](const starfocus::Params& params) {
      starfocus_report report = starfocus::NewReport();
      CHECK(test::OutputOf(&engine, params, scene, &report).bytes == CentreOf(scene));
      CHECK(report.r_max == 0);
    });
  }
}

TEST_CASE("focus range: outside, the blur is that of a lens focused at the adjacent end") {
  const test::Scene scene = test::LayeredScene(kSide, kSide, 5, 4, 8);
  struct {
    double far, near, focus;
  } constexpr kRanges[] = {{6, 9.5, 6}, {-11, -5.25, -5.25}, {-1e6, -5, -5}, {5, 1e6, 5}};
  for (const auto& range : kRanges) {
    test::Config config = test::ConfigFor(scene, 16);
    // The disparities of a gathered cell have a middle that is rounded towards 0. Closing
    // disparities in front of the range may therefore change the PSF of a cell.
    config.tuning.gather = range.focus < 0 ? 0 : 1;
    ForModes(ParamsOf(range.far, range.far / 2 + range.near / 2, range.near),
             [&](const starfocus::Params& params) {
               starfocus::Params single = params;
               single.focus_nearer = single.focus_farther = 0;
               single.focus = range.focus;
               CHECK(test::OutputOf(config, params, scene).bytes ==
                     test::OutputOf(config, single, scene).bytes);
             });
  }
}

TEST_CASE("focus range: surfaces inside the range are sharp beside blurred surfaces") {
  for (const float wall : {-9.0F, 11.0F}) {
    for (const int views : {1, 5}) {
      const test::Scene scene = RectanglesBesideWall(views, wall);
      const test::Scene flat = [&] {
        test::Scene all = scene;
        std::fill(all.disparity.begin(), all.disparity.end(), wall);
        return all;
      }();
      const test::Config config = test::ConfigFor(scene, kReach);
      ForModes(ParamsOf(-2, 3, 5), [&](const starfocus::Params& params) {
        CAPTURES(wall, views);
        if (params.study.mode == STARFOCUS_MODE_BENCHMARK) return;  // as frame, but slow
        const auto made = test::OutputOf(config, params, scene).bytes;
        CHECK(LargestDifference(made, CentreOf(scene), 0, kSide / 2 - kReach) <= 1);
        const auto blurred = test::OutputOf(config, params, flat).bytes;
        CHECK(LargestDifference(made, blurred, kSide / 2 + kReach, kSide) <= 1);
        CHECK(LargestDifference(made, CentreOf(scene), kSide / 2 + kReach, kSide) > 30);
      });
    }
  }
}

}  // namespace focus_range_test
