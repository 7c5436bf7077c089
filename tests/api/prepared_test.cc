// SPDX-License-Identifier: Apache-2.0
// Prepared light fields: the bytes of starfocus_refocus for every lens, and bad input.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/layered_scene.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace prepared_test {
namespace {

constexpr int kViews[] = {1, 5, 9, 17};

// Refocuses with both and compares bytes and counts.
void CheckSame(test::Engine* engine, const starfocus_prepared* prepared, const test::Scene& scene,
               const starfocus_params& params) {
  const starfocus_region& r = params.region;
  const int width = r.width > 0 ? r.width : scene.width;
  const int height = r.height > 0 ? r.height : scene.height;
  test::Output expected(width, height, 3), got(width, height, 3);
  starfocus_report report = {}, prepared_report = {};
  REQUIRE(test::RefocusPreparedRgb(engine->get(), &params, prepared, got.bytes.data(), got.stride,
                                   &prepared_report) == STARFOCUS_OK);
  REQUIRE(test::Refocus(engine, params, scene, &expected, nullptr, nullptr, &report) ==
          STARFOCUS_OK);
  const bool same = got.bytes == expected.bytes;
  CHECK(same);
  CHECK(std::memcmp(&report, &prepared_report, sizeof(report)) == 0);
}

TEST_CASE("prepared: the bytes of starfocus_refocus, in every mode, for many lenses and regions") {
  test::Random random(81);
  constexpr int kSizes[][2] = {{1, 1},    {1, 130},  {130, 1},  {31, 33},   {64, 64},  {65, 63},
                               {100, 37}, {67, 260}, {200, 90}, {129, 128}, {97, 131}, {150, 66}};
  int round = 0;
  for (const auto& size : kSizes) {
    const test::Scene scene =
        test::LayeredScene(size[0], size[1], kViews[round % 4], 7, uint64_t(round) + 800);
    starfocus_config config = test::ConfigFor(scene, 20);
    config.superblock = 32 << random.Int(0, 3);
    config.tuning.max_layer = round % 4 == 0 ? random.Int(0, 1) : 2;
    CAPTURE(round);
    ++round;
    test::Engine engine(config);
    REQUIRE(engine.status() == STARFOCUS_OK);
    test::PreparedMemory memory(config);
    const starfocus_prepared* prepared = memory.Prepare(engine.get(), scene.Field());
    for (int lens = 0; lens < 6; ++lens) {
      starfocus_params params =
          test::Params(random.Real(-12, 12), random.Real(0.3, 1), STARFOCUS_MODE_BLOCK);
      params.renderer = random.Int(0, 2);
      if (lens == 4) params.mode = round % 2 == 0 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLUR;
      if (lens == 5) {
        params.region = {random.Int(0, size[0] - 1), random.Int(0, size[1] - 1), 1, 1};
        params.region.width = random.Int(1, size[0] - params.region.x);
        params.region.height = random.Int(1, size[1] - params.region.y);
      }
      CheckSame(&engine, prepared, scene, params);
    }
  }
}

TEST_CASE("prepared: by one engine for another, which streams in between") {
  const test::Scene scene = test::LayeredScene(140, 100, 5, 7, 11);
  starfocus_config config = test::ConfigFor(scene, 20);
  test::Engine maker(config);
  test::PreparedMemory memory(config);
  const starfocus_prepared* prepared = memory.Prepare(maker.get(), scene.Field());
  config.max_workers = 3;
  config.features |= STARFOCUS_FEATURE_STREAMING;
  config.superblock = 32;
  config.max_blur = 16;
  test::Engine user(config);
  CheckSame(&user, prepared, scene, test::Params(2, 1, STARFOCUS_MODE_BLOCK));
  test::Output whole(140, 100), streamed(140, 100);
  REQUIRE(test::Refocus(&user, test::Params(-3, 1, STARFOCUS_MODE_BLOCK), scene, &whole) ==
          STARFOCUS_OK);
  CheckSame(&user, prepared, scene, test::Params(8, 1, STARFOCUS_MODE_BLOCK));
  REQUIRE(test::Stream(&user, test::Params(-3, 1, STARFOCUS_MODE_BLOCK), scene, &streamed, 9, 9) ==
          STARFOCUS_OK);
  CHECK(streamed.bytes == whole.bytes);
}

TEST_CASE("prepared: what the documentation says of the memory") {
  const test::Scene scene = test::LayeredScene(1000, 800, 5, 7, 11);
  starfocus_config config = test::ConfigFor(scene, 20);
  const double pixels = 1000.0 * 800;
  CHECK(double(test::PreparedMemory(config).bytes) / pixels == doctest::Approx(3.89).epsilon(0.01));
  config.tuning.max_layer = 0;
  CHECK(double(test::PreparedMemory(config).bytes) / pixels == doctest::Approx(2).epsilon(0.01));
}

TEST_CASE("prepared: no size for bad configurations") {
  starfocus_config config = test::ConfigFor(test::LayeredScene(50, 40, 5, 3, 12), 8);
  size_t bytes = 4711;
  CHECK(starfocus_prepared_size(nullptr, &bytes) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_prepared_size(&config, nullptr) == STARFOCUS_ERROR_NULL);
  config.views = 3;
  CHECK(starfocus_prepared_size(&config, &bytes) == STARFOCUS_ERROR_RANGE);
  CHECK(bytes == 4711);
}

TEST_CASE("prepared: engines of another configuration refuse a prepared light field") {
  const test::Scene scene = test::LayeredScene(50, 40, 5, 3, 12);
  const starfocus_config config = test::ConfigFor(scene, 8);
  test::Engine engine(config);
  test::PreparedMemory memory(config);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), scene.Field());
  test::Output out(50, 40);
  const starfocus_params params = test::Params(1);
  void (*const kOthers[])(starfocus_config*) = {
      [](starfocus_config* c) { c->width = 49; },
      [](starfocus_config* c) { c->height = 39; },
      [](starfocus_config* c) { c->views = 1; },
      [](starfocus_config* c) { c->disparity_min = -4; },
      [](starfocus_config* c) { c->disparity_max = 4; },
      [](starfocus_config* c) { c->tuning.max_layer = 1; },
      [](starfocus_config* c) {
        for (int k = 1; k < c->views; ++k) c->positions[k] = {0.25 * k / c->views, 0};
      }};
  for (const auto other : kOthers) {
    starfocus_config changed = config;
    other(&changed);
    test::Engine another(changed);
    CHECK(test::RefocusPreparedRgb(another.get(), &params, prepared, out.bytes.data(), out.stride,
                                   nullptr) == STARFOCUS_ERROR_PREPARED);
  }
  CHECK(out.Untouched());
}

TEST_CASE("prepared: a bad map is refused before anything is written") {
  test::Scene scene = test::LayeredScene(50, 90, 5, 3, 12);
  const starfocus_config config = test::ConfigFor(scene, 8);
  test::Engine engine(config);
  test::PreparedMemory memory(config);
  const std::vector<uint8_t> before(memory.get(), memory.get() + memory.bytes);
  for (const int row : {0, 40, 89}) {
    CAPTURE(row);
    const float good = scene.Disparity(49, row);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), 1000.0f}) {
      scene.Disparity(49, row) = bad;
      const starfocus_light_field field = scene.Field();
      starfocus_prepared* prepared = nullptr;
      CHECK(starfocus_prepare(engine.get(), &field, memory.get(), memory.bytes, &prepared) ==
            (bad == bad ? STARFOCUS_ERROR_DISPARITY : STARFOCUS_ERROR_NOT_FINITE));
      CHECK(std::equal(before.begin(), before.end(), memory.get()));
    }
    scene.Disparity(49, row) = good;
  }
}

}  // namespace
}  // namespace prepared_test
