// SPDX-License-Identifier: Apache-2.0
// What the library tells of itself.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "starfocus/starfocus.h"
#include "starfocus/version.h"

TEST_CASE("version and sizes are those of the headers") {
  CHECK(sf_version() == std::string(SF_VERSION_STRING));
  CHECK(sf_config_size() == sizeof(sf_config));
  CHECK(sf_params_size() == sizeof(sf_params));
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
