// SPDX-License-Identifier: Apache-2.0
// Tests the version, structure sizes, defaults and view positions that the library reports.
#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.h"
#include "starfocus/version.h"
#include "tests/support/test_scene.h"

namespace facts_test {

TEST_CASE("the version of the library is the version of the headers") {
  CHECK(starfocus_version() == std::string(STARFOCUS_VERSION_STRING));
}

// Returns the names of the structures that a header defines.
std::vector<std::string> StructuresOf(const std::string& header) {
  std::ifstream file(std::string(STARFOCUS_SOURCE_DIR) + "/lib/include/starfocus/" + header);
  std::vector<std::string> names;
  const std::regex begin("typedef struct (starfocus_[a-z_]+) \\{.*");
  std::smatch found;
  for (std::string line; std::getline(file, line);) {
    if (std::regex_match(line, found, begin)) names.push_back(found[1]);
  }
  return names;
}

TEST_CASE("the sizes of all structures match the headers") {
  CHECK(starfocus_struct_size("starfocus_config") == sizeof(starfocus_config));
  CHECK(starfocus_struct_size("starfocus_params") == sizeof(starfocus_params));
  CHECK(starfocus_struct_size("starfocus_report") == sizeof(starfocus_report));
  CHECK(starfocus_struct_size("starfocus_depth_config") == sizeof(starfocus_depth_config));
  size_t structures = 0;
  for (const char* header :
       {"starfocus.h", "status.h", "tuning.h", "lens.h", "depth.h", "image.h", "matte.h"}) {
    for (const std::string& name : StructuresOf(header)) {
      CAPTURE(name);
      CHECK(starfocus_struct_size(name.c_str()) > 0);
      ++structures;
    }
  }
  CHECK(structures >= 21);
  for (const char* name :
       {"", "starfocus_", "starfocus_confi", "starfocus_configs", "starfocus_engine"}) {
    CHECK(starfocus_struct_size(name) == 0);
  }
  CHECK(starfocus_struct_size(nullptr) == 0);
}

TEST_CASE("the defaults match the documentation in the headers") {
  starfocus_config config;
  std::memset(&config, test::kPoison, sizeof config);
  starfocus_config_init(&config);
  CHECK(config.size == sizeof config);
  CHECK(config.max_blur == 32);
  CHECK(config.superblock == 0);
  CHECK(config.max_workers == 1);
  CHECK(config.tuning.max_layer == 2);
  CHECK(config.tuning.deblocking == 35);
  CHECK(config.tuning.n_scale == 1);
  CHECK(config.tuning.gather == 1);
  CHECK(config.transfer == STARFOCUS_TRANSFER_SRGB);
  CHECK(config.highlights == 1);
  CHECK(config.features == (STARFOCUS_FEATURE_LINE_SCAN | STARFOCUS_FEATURE_COVERAGE));
  starfocus_params params;
  std::memset(&params, test::kPoison, sizeof params);
  starfocus_params_init(&params);
  CHECK(params.size == sizeof params);
  CHECK(params.mode == STARFOCUS_MODE_BLOCK);
  CHECK(params.renderer == STARFOCUS_RENDERER_AUTO);
  CHECK(params.lens.aperture == 1);
  CHECK(params.lens.focus == 0);
  CHECK(params.lens.focus_nearer == 0);
  CHECK(params.lens.focus_farther == 0);
  CHECK(params.lens.shape == STARFOCUS_SHAPE_FALL_OFF);
  CHECK(params.lens.theta == doctest::Approx(0.26 * 3.14159265358979).epsilon(1e-12));
  CHECK(params.lens.blades == 5);
  CHECK(params.lens.rotation == 0);
  CHECK(params.lens.curvature == 0);
  CHECK(params.lens.ring_inner == 0.5);
  CHECK(params.lens.cats_eye == 0);
  CHECK(params.region.width == 0);
}

TEST_CASE("starfocus_view_position returns the documented positions for star sets of views") {
  const double kExpected[STARFOCUS_MAX_VIEWS][2] = {
      {0, 0},    {1, 0},     {-1, 0},     {0, 1},      {0, -1},     {1, 1},
      {-1, 1},   {1, -1},    {-1, -1},    {0.5, 0},    {-0.5, 0},   {0, 0.5},
      {0, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  double u = 7, v = 7;
  CHECK(starfocus_view_position(-1, &u, &v) == 0);
  CHECK(starfocus_view_position(STARFOCUS_MAX_VIEWS, &u, &v) == 0);
  CHECK(starfocus_view_position(INT32_MAX, &u, &v) == 0);
  CHECK(starfocus_view_position(INT32_MIN, &u, &v) == 0);
  CHECK(starfocus_view_position(0, nullptr, &v) == 0);
  CHECK(starfocus_view_position(0, &u, nullptr) == 0);
  CHECK(u == 7);
  CHECK(v == 7);
  for (int i = 0; i < STARFOCUS_MAX_VIEWS; ++i) {
    CAPTURE(i);
    REQUIRE(starfocus_view_position(i, &u, &v) != 0);
    CHECK(u == kExpected[i][0]);
    CHECK(v == kExpected[i][1]);
  }
}

TEST_CASE("starfocus_simd_target returns a name that is not empty") {
  REQUIRE(starfocus_simd_target() != nullptr);
  CHECK(*starfocus_simd_target() != '\0');
}

}  // namespace facts_test
