// SPDX-License-Identifier: Apache-2.0
// Estimated disparities of scenes that are known, and what starfocus_estimate_disparity refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/depth/estimate.h"
#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace estimate_bytes_test {
namespace {

using namespace test;

TEST_CASE("estimate: a near plane before a far one, to a pixel of its edges") {
  for (const int views : {5, 9, 17}) {
    PlaneScene scene;
    scene.views = views;
    const PlaneField field = RenderPlanes(scene);
    const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
    CAPTURE(views);
    // Two edges of a pixel each are 2 / 96.
    CHECK(ShareOff(scene, found.disparity, 0.28) < 0.022);
    CHECK(ShareOff(scene, found.disparity, 1) < 0.022);
  }
}

TEST_CASE("estimate: a leaning plane stays one, between the steps that are tried") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  scene.lean = 0.04;
  const PlaneField field = RenderPlanes(scene);
  const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
  CHECK(ShareOff(scene, found.disparity, 0.2) < 0.01);
  CHECK(ShareOff(scene, found.disparity, 0.1) < 0.1);
}

TEST_CASE("estimate: a plane that faces the camera is one disparity to the bit") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  const PlaneField field = RenderPlanes(scene);
  for (const float value : MakeMap(field, ConfigOf(field, -3, -3)).disparity) {
    CHECK(value == -3);
  }
}

TEST_CASE("estimate: nobody is sure of the disparities of pictures of one colour") {
  PlaneField field = RenderPlanes(PlaneScene());
  for (auto& view : field.views) std::fill(view.begin(), view.end(), uint8_t{90});
  const MadeMap found = MakeMap(field, ConfigOf(field, -6, 8));
  for (const float value : found.disparity) CHECK((value >= -6 && value <= 8));
  for (const uint8_t value : found.confidence) CHECK(int(value) == 0);
}

TEST_CASE("estimate: confidence is high where one disparity alone fits") {
  const PlaneField field = RenderPlanes(PlaneScene());
  std::vector<uint8_t> confidence = MakeMap(field, ConfigOf(field, -6, 8)).confidence;
  std::sort(confidence.begin(), confidence.end());
  CHECK(confidence[confidence.size() / 2] > 48);
}

TEST_CASE("estimate: pictures of any size, with any range, within it") {
  for (const int width : {1, 2, 17, 33}) {
    for (const int height : {1, 3, 30}) {
      PlaneScene scene;
      scene.width = width;
      scene.height = height;
      scene.views = 5;
      const PlaneField field = RenderPlanes(scene);
      for (const auto& range : {std::pair<float, float>{0, 0}, {-3.3F, 4.7F}, {-500, 500}}) {
        for (const float value :
             MakeMap(field, ConfigOf(field, range.first, range.second)).disparity) {
          CHECK((value >= range.first && value <= range.second));
        }
      }
    }
  }
}

TEST_CASE("estimate: bad configurations have their errors") {
  const PlaneField field = RenderPlanes(PlaneScene());
  const starfocus_depth_config good = ConfigOf(field, -3, 3);
  size_t bytes = 0;
  CHECK(starfocus_estimate_workspace_size(nullptr, &bytes) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_estimate_workspace_size(&good, nullptr) == STARFOCUS_ERROR_NULL);
  const auto status = [&](auto change) {
    starfocus_depth_config config = good;
    change(&config);
    return starfocus_estimate_workspace_size(&config, &bytes);
  };
  CHECK(status([](starfocus_depth_config*) {}) == STARFOCUS_OK);
  CHECK(status([](starfocus_depth_config* c) { c->size = 0; }) == STARFOCUS_ERROR_STRUCTURE);
  CHECK(status([](starfocus_depth_config* c) { ++c->size; }) == STARFOCUS_ERROR_STRUCTURE);
  CHECK(status([](starfocus_depth_config* c) { c->width = 0; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->height = 65536; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->views = 1; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->disparity_min = 4; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->disparity_max = NAN; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->disparity_max = 501; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->max_workers = 0; }) == STARFOCUS_ERROR_RANGE);
  CHECK(status([](starfocus_depth_config* c) { c->max_workers = 65; }) == STARFOCUS_ERROR_RANGE);
}

TEST_CASE("estimate: bad memory has its errors, and nothing is written") {
  const PlaneField field = RenderPlanes(PlaneScene());
  const starfocus_depth_config config = ConfigOf(field, -3, 3);
  size_t bytes = 0;
  REQUIRE(starfocus_estimate_workspace_size(&config, &bytes) == STARFOCUS_OK);
  const Memory memory(bytes + STARFOCUS_ALIGNMENT);
  const auto width = size_t(field.width), pixels = width * size_t(field.height);
  std::vector<float> map(pixels, 42);
  std::vector<uint8_t> confidence(pixels, 42);
  const starfocus_light_field whole = field.Get();
  starfocus_light_field views = whole;
  const auto status = [&](float* to, size_t stride, uint8_t* sure, size_t sure_stride, void* at,
                          size_t size) {
    starfocus_disparity_output out = {to, stride, sure, sure_stride, nullptr, 0, 0};
    return starfocus_estimate_disparity(&config, &views, &out, at, size);
  };
  float* const to = map.data();
  uint8_t* const sure = confidence.data();
  void* const at = memory.data;
  const size_t row = sizeof(float) * width;
  CHECK(status(nullptr, row, sure, width, at, bytes) == STARFOCUS_ERROR_NULL);
  CHECK(status(to, row, sure, width, nullptr, bytes) == STARFOCUS_ERROR_NULL);
  CHECK(status(to, row - 4, sure, width, at, bytes) == STARFOCUS_ERROR_STRIDE);
  CHECK(status(to, row + 2, sure, width, at, bytes) == STARFOCUS_ERROR_STRIDE);
  CHECK(status(to, row, sure, width - 1, at, bytes) == STARFOCUS_ERROR_STRIDE);
  CHECK(status(to, row, sure, width, at, bytes - 1) == STARFOCUS_ERROR_WORKSPACE);
  CHECK(status(to, row, sure, width, static_cast<char*>(at) + 4, bytes) ==
        STARFOCUS_ERROR_WORKSPACE);
  CHECK(status(static_cast<float*>(at), row, sure, width, at, bytes) == STARFOCUS_ERROR_OVERLAP);
  CHECK(status(to, row, reinterpret_cast<uint8_t*>(to) + 7, width, at, bytes) ==
        STARFOCUS_ERROR_OVERLAP);
  CHECK(status(to, row, const_cast<uint8_t*>(field.views[16].data()), width, at, bytes) ==
        STARFOCUS_ERROR_OVERLAP);
  views.views[16].planes[0] = nullptr;
  CHECK(status(to, row, sure, width, at, bytes) == STARFOCUS_ERROR_NULL);
  views = whole;
  views.views[3].strides[0] = 3 * width - 1;
  CHECK(status(to, row, sure, width, at, bytes) == STARFOCUS_ERROR_STRIDE);
  for (const float value : map) REQUIRE(value == 42);
  for (const uint8_t value : confidence) REQUIRE(value == 42);
  views = whole;
  starfocus_disparity_output out = {to, row, nullptr, 0, nullptr, 0, 0};
  starfocus_depth_config fails = config;
  fails.runner = [](void*, starfocus_job, void*, int32_t) { return 0; };
  CHECK(starfocus_estimate_disparity(&fails, &views, &out, at, bytes) == STARFOCUS_ERROR_RUNNER);
  CHECK(starfocus_estimate_disparity(&config, &views, nullptr, at, bytes) == STARFOCUS_ERROR_NULL);
}

}  // namespace
}  // namespace estimate_bytes_test
