// SPDX-License-Identifier: Apache-2.0
// sf_depth_config.progress: what it is told, and that a call it cancels leaves nothing behind that
// the next one could read.
#include <doctest/doctest.h>

#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"
#include "tests/support/watch.h"

namespace depth_progress_test {
namespace {

using test::Watch;

// The maps of a scene, each in the same memory as those before.
struct Maps {
  bool repairs;
  test::PlaneField views;
  std::vector<float> given;  // noisy and with holes
  sf_depth_config config;
  size_t bytes = 0;

  Maps(int count, bool repair) : repairs(repair) {
    test::PlaneScene scene;
    scene.width = 150;
    scene.height = 140;
    scene.views = count;
    views = test::RenderPlanes(scene);
    config = test::ConfigOf(views, -4, 7);
    config.max_workers = 2;
    test::Random random(7);
    for (int i = 0; i < scene.width * scene.height; ++i) {
      const double noise = random.Real(-0.7, 0.7);
      given.push_back(float(scene.DisparityAt(i % scene.width) + noise));
    }
    REQUIRE((repairs ? sf_repair_size : sf_estimate_size)(&config, &bytes) == SF_OK);
  }

  sf_status Make(test::Memory* memory, Watch* watch, sf_runner runner, std::vector<float>* map) {
    config.runner = runner;
    config.progress = watch != nullptr ? Watch::Progress : nullptr;
    config.progress_data = watch;
    sf_light_field field = views.Get();
    const size_t stride = sizeof(float) * size_t(config.width);
    if (repairs) {
      field.depth = sf_depth_float(given.data(), stride, config.width, config.height);
    }
    map->assign(given.size(), -1);
    sf_map out = {map->data(), stride, nullptr, 0, nullptr, 0, 0};
    const auto make = repairs ? sf_repair_disparity : sf_estimate_disparity;
    return make(&config, &field, &out, memory->data, memory->bytes);
  }
};

void CheckMaps(int views, bool repairs, int parts) {
  CAPTURE(views);
  CAPTURE(repairs);
  Maps maps(views, repairs);
  std::vector<float> expected, map;
  {
    test::Memory fresh(maps.bytes);
    REQUIRE(maps.Make(&fresh, nullptr, nullptr, &expected) == SF_OK);
  }
  test::Memory memory(maps.bytes);
  for (int stop = 0;; ++stop) {
    CAPTURE(stop);
    Watch watch(stop);
    const sf_runner runner = stop % 2 == 0 ? nullptr : test::RunBackwards;
    const sf_status status = maps.Make(&memory, &watch, runner, &map);
    CHECK(watch.Good());
    if (watch.calls <= stop) {
      CHECK(status == SF_OK);
      CHECK(watch.Ended());
      CHECK(watch.rows == maps.config.height);
      CHECK(map == expected);
      // Of each part every tile, and the end.
      CHECK(watch.calls > parts);
      break;
    }
    REQUIRE(status == SF_ERROR_CANCELLED);
    REQUIRE(maps.Make(&memory, nullptr, nullptr, &map) == SF_OK);
    CHECK(map == expected);
  }
}

TEST_CASE("maps: progress is told tile by tile, and cancels at any of them") {
  CheckMaps(5, false, 3);
  CheckMaps(5, true, 6);
  CheckMaps(1, true, 5);
}

}  // namespace
}  // namespace depth_progress_test
