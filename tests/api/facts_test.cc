// SPDX-License-Identifier: Apache-2.0
// What the library tells of itself.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <string>

#include "starfocus/starfocus.h"
#include "starfocus/version.h"
#include "tests/support/test_scene.h"

TEST_CASE("version and sizes are those of the headers") {
  CHECK(sf_version() == std::string(SF_VERSION_STRING));
  CHECK(sf_config_size() == sizeof(sf_config));
  CHECK(sf_params_size() == sizeof(sf_params));
}

TEST_CASE("defaults are those that the header tells") {
  sf_config config;
  std::memset(&config, test::kPoison, sizeof config);
  sf_config_init(&config);
  CHECK(config.version == SF_ABI_VERSION);
  CHECK(config.max_blur == 32);
  CHECK(config.largest_block == 0);
  CHECK(config.max_workers == 1);
  CHECK(config.streaming == 0);
  CHECK(config.max_layer == 2);
  CHECK(config.deblocking == 35);
  CHECK(config.n_scale == 1);
  CHECK(config.skips == 1);
  CHECK(config.gather == 1);
  CHECK(config.theta == doctest::Approx(0.26 * 3.14159265358979).epsilon(1e-12));
  CHECK(config.aperture_shape == SF_SHAPE_FALL_OFF);
  CHECK(config.blades == 5);
  CHECK(config.rotation == 0);
  CHECK(config.curvature == 0);
  CHECK(config.ring_inner == 0.5F);
  CHECK(config.cats_eye == 0);
  CHECK(config.transfer == SF_TRANSFER_SRGB);
  CHECK(config.highlights == 1);
  for (uint32_t reserved : config.reserved) CHECK(reserved == 0);
  sf_params params;
  std::memset(&params, test::kPoison, sizeof params);
  sf_params_init(&params);
  CHECK(params.version == SF_ABI_VERSION);
  CHECK(params.mode == SF_MODE_BLOCK);
  CHECK(params.rule == SF_RULE_DEFAULT);
  CHECK(params.aperture == 1);
  CHECK(params.focus == 0);
  CHECK(!params.clock);
  CHECK(!params.on_block);
  CHECK(params.region.width == 0);
  for (uint32_t reserved : params.reserved) CHECK(reserved == 0);
}

TEST_CASE("view positions") {
  const double kExpected[SF_MAX_VIEWS][2] = {
      {0, 0},    {1, 0},     {-1, 0},     {0, 1},      {0, -1},     {1, 1},
      {-1, 1},   {1, -1},    {-1, -1},    {0.5, 0},    {-0.5, 0},   {0, 0.5},
      {0, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  double u = 7, v = 7;
  CHECK(sf_view_position(-1, &u, &v) == 0);
  CHECK(sf_view_position(SF_MAX_VIEWS, &u, &v) == 0);
  CHECK(sf_view_position(INT32_MAX, &u, &v) == 0);
  CHECK(sf_view_position(INT32_MIN, &u, &v) == 0);
  CHECK(sf_view_position(0, nullptr, &v) == 0);
  CHECK(sf_view_position(0, &u, nullptr) == 0);
  CHECK(u == 7);
  CHECK(v == 7);
  for (int i = 0; i < SF_MAX_VIEWS; ++i) {
    CAPTURE(i);
    REQUIRE(sf_view_position(i, &u, &v) != 0);
    CHECK(u == kExpected[i][0]);
    CHECK(v == kExpected[i][1]);
  }
}

TEST_CASE("the SIMD target has a name") {
  REQUIRE(sf_simd_target() != nullptr);
  CHECK(*sf_simd_target() != '\0');
}
