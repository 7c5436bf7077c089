// SPDX-License-Identifier: Apache-2.0
// Estimates the disparities of known scenes, and checks which arguments
// starfocus_estimate_disparity rejects.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"
#include "tests/support/config.h"

namespace estimate_bytes_test {
namespace {

using namespace test;

TEST_CASE("estimate: the edges of a near plane have errors of at most one pixel") {
  for (const int views : {5, 9, 17}) {
    PlaneScene scene;
    scene.views = views;
    const PlaneField field = RenderPlanes(scene);
    const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
    CAPTURE(views);
    // Two edges of the near plane with an error of one pixel each give wrong disparities in 2 of 96
    // columns.
    CHECK(ShareOff(scene, found.disparity, 0.28) < 0.022);
    CHECK(ShareOff(scene, found.disparity, 1) < 0.022);
  }
}

TEST_CASE("estimate: other sets of views have small errors where a side view shows the pixel") {
  const std::vector<std::vector<starfocus_position>> sets = {
      {{0, 0}, {1, 0}},
      {{0, 0}, {-0.9, 0.3}},
      {{0, 0}, {0, 1}},
      {{0, 0}, {1, 0}, {-1, 0}},
      {{0, 0}, {1, 0}, {0, 1}},
      {{0, 0}, {0.4, 0.3}, {-0.8, 0.5}, {0.1, -0.7}},
      {{0, 0}, {1, 0}, {-1, 0}, {0.5, 0}, {-0.5, 0}, {0.25, 0}, {-0.25, 0}}};
  for (const auto& positions : sets) {
    PlaneScene scene;
    scene.positions = positions;
    const PlaneField field = RenderPlanes(scene);
    const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
    CAPTURE(&positions - &sets[0]);
    CHECK(ShareOff(scene, found.disparity, 1) < 0.035);
    CHECK(ShareOff(scene, found.disparity, 0.28) < 0.16);
  }
}

TEST_CASE("estimate: in a pair, pixels hidden in the side view get the far disparity") {
  for (const double u : {1.0, -1.0}) {
    PlaneScene scene;
    scene.positions = {{0, 0}, {u, 0}};
    const PlaneField field = RenderPlanes(scene);
    const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
    // The near plane moves by 8 pixels relative to the far plane, and hides as many pixels of the
    // far plane next to its left or right edge. Three columns at an end of the picture move out of
    // the side view. The first and the last hidden column may be wrong by a pixel.
    const int hidden = u > 0 ? 30 - 8 : 62, outside = u > 0 ? scene.width - 2 : 0;
    int pixels = 0, right = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const bool is_hidden = x > hidden && x < hidden + 7;
        if (!is_hidden && (x < outside || x >= outside + 2)) continue;
        const size_t at = size_t(y) * size_t(scene.width) + size_t(x);
        ++pixels;
        right += std::fabs(found.disparity[at] + 3) < 0.6 && found.confidence[at] == 0;
      }
    }
    CAPTURE(u);
    CHECK(pixels == 8 * scene.height);
    CHECK(right > 0.97 * pixels);
  }
}

TEST_CASE("estimate: positions of the star give the same map as no positions") {
  PlaneScene scene;
  scene.views = 5;
  const PlaneField field = RenderPlanes(scene);
  test::Config config = ConfigOf(field, -6, 8);
  const MadeMap without = MakeMap(field, config);
  for (int k = 0; k < 5; ++k) {
    starfocus_view_position(k, &config.positions[k].u, &config.positions[k].v, nullptr);
  }
  const MadeMap with = MakeMap(field, config);
  CHECK(with.disparity == without.disparity);
  CHECK(with.confidence == without.confidence);
}

TEST_CASE("estimate: disparities of a slanted plane are interpolated between labels") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  scene.lean = 0.04;
  const PlaneField field = RenderPlanes(scene);
  const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
  CHECK(ShareOff(scene, found.disparity, 0.2) < 0.01);
  CHECK(ShareOff(scene, found.disparity, 0.1) < 0.1);
}

TEST_CASE("estimate: pictures of one colour have confidence 0") {
  PlaneField field = RenderPlanes(PlaneScene());
  for (auto& view : field.views) std::fill(view.begin(), view.end(), uint8_t{90});
  const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
  CheckWithin(found.disparity, -6, 8);
  for (const uint8_t value : found.confidence) CHECK(int(value) == 0);
}

TEST_CASE("estimate: confidence is high where only one disparity fits") {
  const PlaneField field = RenderPlanes(PlaneScene());
  std::vector<uint8_t> confidence = MakeMap(field, ConfigOf(field, -6, 8)).confidence;
  std::sort(confidence.begin(), confidence.end());
  CHECK(confidence[confidence.size() / 2] > 48);
}

TEST_CASE("estimate: disparities are within the configured range for pictures of any size") {
  for (const PlaneScene& scene : ScenesOfAnySize()) {
    const PlaneField field = RenderPlanes(scene);
    for (const auto& [low, high] :
         {std::pair<float, float>{0, 0.25F}, {-3.3F, 4.7F}, {-500, 500}}) {
      CheckWithin(MakeMap(field, ConfigOf(field, low, high)).disparity, low, high);
    }
  }
}

}  // namespace
}  // namespace estimate_bytes_test
