// SPDX-License-Identifier: Apache-2.0
// Random estimates and repairs of disparity maps whose result or symmetry is known.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"
#include "tests/operations/picture_operations.h"
#include "tests/operations/random_cases.h"
#include "tests/support/symmetry.h"

namespace known_maps_slow_test {
namespace {

using test::Random;

constexpr float kMost = 6;     // Largest absolute disparity.
constexpr int kPlaneMost = 4;  // Largest absolute disparity of planes.

struct Map {
  starfocus_status status = STARFOCUS_OK;
  std::vector<float> disparity;
  std::vector<uint8_t> confidence;

  bool operator==(const Map& other) const {
    const size_t bytes = sizeof(float) * disparity.size();
    return status == other.status && confidence == other.confidence &&
           std::memcmp(disparity.data(), other.disparity.data(), bytes) == 0;
  }
};

int RunBackwards(void*, starfocus_job job, void* data, int32_t count) {
  for (int32_t i = count; i-- > 0;) job(data, i, i % 3);
  return 0;
}

Map Make(const test::Scene& scene, bool repairs, starfocus_runner runner, Random* random) {
  test::Config config = test::ConfigFor(scene);
  config.disparity_min = -kMost;
  config.disparity_max = kMost;
  config.max_workers = runner == nullptr ? 1 : 3;
  const starfocus_callbacks callbacks = test::RunBy(runner);
  size_t bytes = 0;
  REQUIRE(starfocus_map_workspace_size(&config, repairs ? 1 : 0, &bytes, nullptr) == STARFOCUS_OK);
  const properties::Memory memory(bytes, random->Int(0, 256));
  const auto width = static_cast<size_t>(scene.width);
  Map map;
  map.disparity.assign(width * static_cast<size_t>(scene.height), 0);
  map.confidence.assign(map.disparity.size(), 0);
  const starfocus_light_field field = scene.Field();
  const auto make = repairs ? starfocus_repair_disparity : starfocus_estimate_disparity;
  starfocus_disparity_output out = {
      map.disparity.data(), sizeof(float) * width, map.confidence.data(), width, nullptr, 0, 0};
  map.status = make(&config, &callbacks, &field, &out, memory.get(), bytes, nullptr);
  return map;
}

// Draws a plane of noise, which every view shows shifted by whole pixels.
void DrawPlane(int disparity, Random* random, test::Scene* scene) {
  const int margin = std::abs(disparity), stride = scene->width + 2 * margin;
  const std::vector<uint8_t> noise =
      test::RandomBytes(3 * size_t(stride) * size_t(scene->height + 2 * margin), random);
  for (int view = 0; view < scene->views(); ++view) {
    const starfocus_position at = scene->PositionOf(view);
    const int left = margin + int(at.u * disparity), top = margin + int(at.v * disparity);
    for (int y = 0; y < scene->height; ++y) {
      std::memcpy(scene->Pixel(view, 0, y),
                  &noise[3 * (size_t(top + y) * size_t(stride) + size_t(left))],
                  3 * size_t(scene->width));
    }
  }
}

TEST_CASE("known maps: a repair keeps the map of one plane, and of a picture of one colour") {
  properties::ForRandomCases(40, [](Random* random) {
    // The picture is larger than the disparity of the plane. With a larger disparity, side views
    // would show nothing of the centre view.
    constexpr int kLeast = 2 * kPlaneMost + 1;
    test::Scene scene = test::EmptyScene(random->Int(kLeast, 90), random->Int(kLeast, 60),
                                         test::kStars[random->Int(0, 3)], -kMost, kMost);
    const int disparity = 2 * random->Int(-kPlaneMost / 2, kPlaneMost / 2);
    const bool blank = random->Int(0, 1) == 0;  // views of one colour give no information
    const uint8_t grey[3] = {random->Byte(), 9, 200};
    if (blank) properties::SetColour(grey, &scene);
    if (!blank) DrawPlane(disparity, random, &scene);
    for (float& value : scene.disparity) value = float(disparity);
    const Map map = Make(scene, true, nullptr, random);
    CAPTURES(scene.width, scene.height, scene.views(), disparity, blank);
    CHECK(map.status == STARFOCUS_OK);
    CHECK((map.disparity == scene.disparity));
  });
}

TEST_CASE("known maps: the mirrored light field has the mirrored map, on any workers and memory") {
  properties::ForRandomCases(60, [](Random* random) {
    const int views = test::kStars[random->Int(0, 3)];
    const bool repairs = views == 1 || random->Int(0, 1) == 0;
    test::Scene scene = test::RandomScene(random->Int(1, 90), random->Int(1, 60), views, -kMost,
                                          kMost, random->Next());
    if (random->Int(0, 1) == 0) test::NoisyDisparity(&scene, random);
    if (repairs && random->Int(0, 2) == 0) {
      for (int k = scene.width * scene.height / 8; k > 0; --k) {
        scene.Disparity(random->Int(0, scene.width - 1), random->Int(0, scene.height - 1)) =
            std::numeric_limits<float>::quiet_NaN();
      }
    }
    CAPTURES(scene.width, scene.height, views, repairs);
    const Map map = Make(scene, repairs, nullptr, random);
    if (map.status == STARFOCUS_ERROR_ALL_INVALID) return;
    REQUIRE(map.status == STARFOCUS_OK);
    CHECK((Make(scene, repairs, RunBackwards, random) == map));
    const Map other = Make(test::Move({false, true, false}, scene), repairs, nullptr, random);
    REQUIRE(other.status == STARFOCUS_OK);
    int differ = 0;
    for (int n = 0; n < scene.width * scene.height; ++n) {
      const int m = n / scene.width * scene.width + (scene.width - 1 - n % scene.width);
      differ += map.disparity[size_t(n)] != other.disparity[size_t(m)];
    }
    CHECK(differ == 0);
  });
}

}  // namespace
}  // namespace known_maps_slow_test
