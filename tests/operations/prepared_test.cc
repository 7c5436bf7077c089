// SPDX-License-Identifier: Apache-2.0
// Tests which engines may use a prepared light field, and the size of the memory of the light
// field. operations_bytes_test.cc tests the bytes refocused from prepared light fields.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/scenes.h"
#include "tests/support/test_scene.h"

namespace prepared_test {
namespace {

TEST_CASE("prepared: refocusing does not read the map again, and previews read no plane again") {
  test::Scene scene = test::LayeredScene(90, 70, 5, 7, 13);
  scene.coverage.assign(size_t{90} * 70, 255);
  test::Config config = test::ConfigFor(scene, 20);
  config.previews = 1;
  test::Engine engine(config);
  test::PreparedMemory memory(engine);
  const starfocus::Params params = test::Params(2, 1, STARFOCUS_MODE_BLOCK);
  const test::Output expected = test::OutputOf(&engine, params, scene);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), scene.Field());
  const auto preview = [&] {
    test::Output out(45, 35);
    const starfocus_image image = starfocus_image_rgb(out.bytes.data(), out.stride);
    REQUIRE(test::Preview(engine.get(), &params, prepared, 1, &image, nullptr) == STARFOCUS_OK);
    return out.bytes;
  };
  const std::vector<uint8_t> small = preview();
  for (float& disparity : scene.disparity) disparity = std::numeric_limits<float>::quiet_NaN();
  test::Output got(90, 70);
  REQUIRE(test::RefocusPreparedRgb(engine.get(), &params, prepared, got.bytes.data(), got.stride,
                                   nullptr) == STARFOCUS_OK);
  CHECK((got.bytes == expected.bytes));
  for (auto& picture : scene.pictures) std::fill(picture.begin(), picture.end(), uint8_t{0});
  std::fill(scene.coverage.begin(), scene.coverage.end(), uint8_t{0});
  CHECK((preview() == small));
}

TEST_CASE("prepared: the memory has the documented size") {
  const test::Scene scene = test::LayeredScene(1000, 800, 5, 7, 11);
  test::Config config = test::ConfigFor(scene, 20);
  const double pixels = 1000.0 * 800;
  CHECK(double(test::PreparedMemory(config).bytes) / pixels == doctest::Approx(3.89).epsilon(0.01));
  config.tuning.max_layer = 0;
  CHECK(double(test::PreparedMemory(config).bytes) / pixels == doctest::Approx(2).epsilon(0.01));
}

TEST_CASE("prepared: the size query rejects null pointers and wrong configurations") {
  test::Config config = test::ConfigFor(test::LayeredScene(50, 40, 5, 3, 12), 8);
  size_t bytes = 4711;
  CHECK(starfocus_prepared_size(nullptr, &bytes, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_prepared_size(&config, nullptr, nullptr) == STARFOCUS_ERROR_NULL);
  config.previews = STARFOCUS_MAX_PREVIEW + 1;
  starfocus_problem problem = {};
  CHECK(starfocus_prepared_size(&config, &bytes, &problem) == STARFOCUS_ERROR_RANGE);
  CHECK(std::strcmp(problem.field, "previews") == 0);
  CHECK(bytes == 4711);
}

TEST_CASE("prepared: engines of another configuration reject a prepared light field") {
  const test::Scene scene = test::LayeredScene(50, 40, 5, 3, 12);
  const test::Config config = test::ConfigFor(scene, 8);
  test::Engine engine(config);
  test::PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), scene.Field());
  test::Output out(50, 40);
  const starfocus::Params params = test::Params(1);
  void (*const kOthers[])(test::Config*) = {[](test::Config* c) { c->width = 49; },
                                            [](test::Config* c) { c->height = 39; },
                                            [](test::Config* c) { c->views = 1; },
                                            [](test::Config* c) { c->disparity_min = -4; },
                                            [](test::Config* c) { c->disparity_max = 4; },
                                            [](test::Config* c) { c->tuning.max_layer = 1; },
                                            [](test::Config* c) {
                                              for (int k = 1; k < c->views; ++k)
                                                c->positions[k] = {0.25 * k / c->views, 0};
                                            }};
  for (const auto other : kOthers) {
    test::Config changed = config;
    other(&changed);
    test::Engine another(changed);
    CHECK(test::RefocusPreparedRgb(another.get(), &params, prepared, out.bytes.data(), out.stride,
                                   nullptr) == STARFOCUS_ERROR_PREPARED);
  }
  CHECK(out.Untouched());
}

}  // namespace
}  // namespace prepared_test
