// SPDX-License-Identifier: Apache-2.0
// Estimates the disparities of known scenes, and checks which arguments
// starfocus_estimate_disparity rejects.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"

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

TEST_CASE("estimate: disparities of a slanted plane are interpolated between labels") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  scene.lean = 0.04;
  const PlaneField field = RenderPlanes(scene);
  const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
  CHECK(ShareOff(scene, found.disparity, 0.2) < 0.01);
  CHECK(ShareOff(scene, found.disparity, 0.1) < 0.1);
}

TEST_CASE("estimate: if the range is one disparity, every pixel has exactly this disparity") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  const PlaneField field = RenderPlanes(scene);
  for (const float value : MakeMap(field, ConfigOf(field, -3, -3)).disparity) {
    CHECK(value == -3);
  }
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
    for (const auto& [low, high] : {std::pair<float, float>{0, 0}, {-3.3F, 4.7F}, {-500, 500}}) {
      CheckWithin(MakeMap(field, ConfigOf(field, low, high)).disparity, low, high);
    }
  }
}

}  // namespace
}  // namespace estimate_bytes_test
