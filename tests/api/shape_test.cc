// SPDX-License-Identifier: Apache-2.0
// Each illegal value of an opening's fields is told, whatever the shape, and makes nothing.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace shape_test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

sf_config ConfigOf(int shape) {
  sf_config config = test::ConfigFor(test::EmptyScene(40, 30, 5, -2, 2), 6);
  config.aperture_shape = static_cast<int16_t>(shape);
  return config;
}

// The field that both functions that check a configuration refuse; "" if they accept it.
std::string RefusedField(sf_config config) {
  sf_problem problem = {};
  config.problem = &problem;
  size_t bytes = 1;
  const sf_status status = sf_workspace_size(&config, &bytes);
  if (status != SF_OK) CHECK(bytes == 1);
  CHECK(problem.status == status);
  const std::string field = problem.field;
  size_t prepared = 1;
  CHECK(sf_prepared_size(&config, &prepared) == status);
  CHECK(problem.field == field);
  return field;
}

TEST_CASE("shape: fields outside their ranges are told") {
  for (int shape = SF_SHAPE_FALL_OFF; shape <= SF_SHAPE_RING; ++shape) {
    CAPTURE(shape);
    const auto with = [&](auto set) {
      sf_config config = ConfigOf(shape);
      set(&config);
      return RefusedField(config);
    };
    CHECK(with([](sf_config*) {}) == "");
    for (const int other : {-1, 4, 32767, -32768}) {
      CHECK(with([&](sf_config* c) { c->aperture_shape = int16_t(other); }) == "aperture_shape");
    }
    for (const int blades : {0, 2, 13, -5}) {
      CHECK(with([&](sf_config* c) { c->blades = int16_t(blades); }) == "blades");
    }
    for (const float value : {-360.1F, 360.1F, kNan, kInf, -kInf}) {
      CHECK(with([&](sf_config* c) { c->rotation = value; }) == "rotation");
    }
    for (const float value : {-0.001F, 1.001F, kNan, kInf}) {
      CHECK(with([&](sf_config* c) { c->curvature = value; }) == "curvature");
      CHECK(with([&](sf_config* c) { c->cats_eye = value; }) == "cats_eye");
    }
    for (const float value : {-0.001F, 0.901F, kNan, kInf}) {
      CHECK(with([&](sf_config* c) { c->ring_inner = value; }) == "ring_inner");
    }
  }
}

TEST_CASE("shape: what needs more memory, and that the others need none") {
  const auto bytes_of = [](sf_config config) {
    size_t bytes = 0;
    REQUIRE(sf_workspace_size(&config, &bytes) == SF_OK);
    return bytes;
  };
  const size_t plain = bytes_of(ConfigOf(SF_SHAPE_FALL_OFF));
  CHECK(bytes_of(ConfigOf(SF_SHAPE_DISC)) == plain);
  CHECK(bytes_of(ConfigOf(SF_SHAPE_POLYGON)) > plain);
  sf_config cats_eye = ConfigOf(SF_SHAPE_FALL_OFF);
  cats_eye.cats_eye = 0.5F;
  // A block's weights take some of what a worker has anyway, but at the largest blur.
  CHECK(bytes_of(cats_eye) >= plain);
  sf_config far = ConfigOf(SF_SHAPE_FALL_OFF);
  far.largest_block = 32;
  far.max_blur = SF_MAX_BLUR;
  const size_t far_plain = bytes_of(far);
  far.cats_eye = 1;
  CHECK(bytes_of(far) > far_plain);
  std::vector<char> memory(plain);
  sf_config bad = ConfigOf(SF_SHAPE_DISC);
  bad.blades = 99;
  sf_engine* engine = reinterpret_cast<sf_engine*>(memory.data());
  CHECK(sf_init(&bad, memory.data(), memory.size(), &engine) == SF_ERROR_RANGE);
  CHECK(engine == nullptr);
}

}  // namespace
}  // namespace shape_test
