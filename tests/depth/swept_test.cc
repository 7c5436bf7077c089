// SPDX-License-Identifier: Apache-2.0
// Tests for how a repair selects the pixels at which it tries all disparities.
#include "lib/depth/swept.h"

#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "lib/depth/sweep.h"
#include "starfocus/starfocus.hpp"
#include "tests/depth/depth_scene.h"

namespace swept_test {
namespace {

using namespace starfocus;
using test::PlaneScene;

// Returns a mask of the pixels at which a repair of the map `given` tries all disparities.
std::vector<uint8_t> SweptOf(const PlaneScene& scene, const std::vector<float>& given) {
  const test::PlaneField field = RenderPlanes(scene);
  const SweepSetup setup = starfocus::MakeSetup(ConfigOf(field, -6, 8), true);
  starfocus::Arena counted(nullptr);
  TakeEstimate(setup, 1, &counted);
  const test::Memory bytes(counted.Bytes());
  starfocus::Arena arena(bytes.data);
  const EstimateMemory memory = TakeEstimate(setup, 1, &arena);
  starfocus_light_field light_field = field.Get();
  light_field.depth = starfocus_depth_float(given.data(), sizeof(float) * size_t(scene.width),
                                            scene.width, scene.height);
  const int tiles = setup.columns * setup.rows;
  for (int k = 0; k < tiles; ++k) ReadGiven(setup, light_field, TileOf(setup, k), memory);
  for (int k = 0; k < tiles; ++k) {
    FindTrusted(setup, TileOf(setup, k), memory.given, memory.trusted);
    FindDoubts(setup, light_field, TileOf(setup, k), memory);
  }
  for (int k = 0; k < tiles; ++k)
    FindSwept(setup, TileOf(setup, k), memory.workers[0].cost, memory);
  return {memory.swept, memory.swept + given.size()};
}

TEST_CASE(
    "swept: in a correct map, all disparities are tried only around steps, even at tile "
    "boundaries") {
  PlaneScene scene;
  scene.width = 400;
  scene.near_left = 130;
  scene.near_right = 262;
  for (const int views : {5, 9, 17}) {
    scene.views = views;
    const std::vector<uint8_t> swept = SweptOf(scene, MapOf(scene));
    for (int x = 0; x < scene.width; ++x) {
      // The repair distrusts the pixels on both sides of a step, and tries all disparities within
      // kSweptRadius of a distrusted pixel.
      const bool near = (x >= 129 - kSweptRadius && x <= 130 + kSweptRadius) ||
                        (x >= 261 - kSweptRadius && x <= 262 + kSweptRadius);
      CAPTURE(x);
      for (int y = 0; y < scene.height; ++y) {
        REQUIRE(int(swept[size_t(y * scene.width + x)]) == int(near));
      }
    }
  }
}

TEST_CASE("swept: all disparities are tried where a smooth map contradicts the views") {
  PlaneScene scene;
  scene.near_left = scene.near_right = 0;
  std::vector<float> given = MapOf(scene);
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 40; x < 80; ++x) given[size_t(y * scene.width + x)] += 2.5F;
  }
  const std::vector<uint8_t> swept = SweptOf(scene, given);
  int inside = 0, outside = 0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 50; x < 70; ++x) inside += swept[size_t(y * scene.width + x)];
    for (int x = 0; x < 30; ++x) outside += swept[size_t(y * scene.width + x)];
  }
  CHECK(inside > scene.height * 20 * 9 / 10);
  CHECK(outside == 0);
}

TEST_CASE("swept: ForSwept lists the runs of swept pixels within the given part of a row") {
  SweepSetup setup = {};
  setup.width = 8;
  const uint8_t swept[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 1, 0, 1, 1};
  std::vector<std::pair<int, int>> runs;
  const auto add = [&](int begin, int end) { runs.emplace_back(begin, end); };
  starfocus::ForSwept(setup, swept, 1, 1, 7, add);
  CHECK(runs == std::vector<std::pair<int, int>>{{1, 2}, {4, 5}, {6, 7}});
  runs.clear();
  starfocus::ForSwept(setup, swept, 1, 2, 4, add);
  CHECK(runs.empty());
  starfocus::ForSwept(setup, nullptr, 1, 2, 4, add);
  CHECK(runs == std::vector<std::pair<int, int>>{{2, 4}});
}

}  // namespace
}  // namespace swept_test
