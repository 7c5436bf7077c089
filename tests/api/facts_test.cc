// SPDX-License-Identifier: Apache-2.0
// Tests the version, structure sizes, defaults and view positions that the library reports.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "starfocus/version.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace facts_test {

TEST_CASE("the version of the library is the version of the headers") {
  uint32_t abi = 0;
  CHECK(starfocus_version(&abi) == std::string(STARFOCUS_VERSION_STRING));
  CHECK(abi == STARFOCUS_ABI);
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

TEST_CASE("the fields of all structures are listed, without gaps or overlaps") {
  CHECK(starfocus_fields("starfocus_config", nullptr, nullptr) == sizeof(starfocus_config));
  CHECK(starfocus_fields("starfocus_params", nullptr, nullptr) == sizeof(starfocus_params));
  CHECK(starfocus_fields("starfocus_report", nullptr, nullptr) == sizeof(starfocus_report));
  constexpr size_t kPointer = sizeof(void*);
  constexpr size_t kSizes[] = {4, 4, 8, 8, 8, kPointer, 0, kPointer, kPointer};
  size_t structures = 0;
  for (const char* header : {"starfocus.h", "experimental.h", "depth.h", "image.h", "matte.h"}) {
    for (const std::string& name : StructuresOf(header)) {
      CAPTURE(name);
      const starfocus_field* fields = nullptr;
      int32_t count = 0;
      const size_t size = starfocus_fields(name.c_str(), &fields, &count);
      REQUIRE(size > 0);
      size_t end = 0;
      for (const starfocus_field* field = fields; field != fields + count; ++field) {
        CAPTURE(field->name);
        const bool is_nested = field->type == STARFOCUS_FIELD_STRUCTURE;
        const size_t target = starfocus_fields(field->structure, nullptr, nullptr);
        CHECK((target > 0) == (field->structure != nullptr));
        CHECK((target == 0 || is_nested || field->type == STARFOCUS_FIELD_POINTER));
        const size_t bytes = is_nested ? target : kSizes[field->type];
        REQUIRE(bytes > 0);
        CHECK(field->offset >= end);
        CHECK(field->offset - end < 8);  // only padding
        end = field->offset + bytes * field->count;
      }
      CHECK(end <= size);
      CHECK(size - end < 8);
      ++structures;
    }
  }
  CHECK(structures >= 24);
  for (const char* name :
       {"", "starfocus_", "starfocus_confi", "starfocus_configs", "starfocus_engine"}) {
    CHECK(starfocus_fields(name, nullptr, nullptr) == 0);
  }
  CHECK(starfocus_fields(nullptr, nullptr, nullptr) == 0);
}

TEST_CASE("the types of pointers are listed") {
  struct Row {
    const char *structure, *name, *target;
    int32_t type;
  };
  for (const Row& row : {
           Row{"starfocus_config", "tuning", "starfocus_tuning", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_params", "previous", "starfocus_previous", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_params", "study", "starfocus_study", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_previous", "light_field", "starfocus_light_field",
               STARFOCUS_FIELD_POINTER},
           Row{"starfocus_previous", "out", "starfocus_image", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_report", "layers", "starfocus_layer_report", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_callbacks", "observer", "starfocus_observer", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_callbacks", "runner", "", STARFOCUS_FIELD_FUNCTION},
           Row{"starfocus_callbacks", "runner_data", "", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_allocator", "release", "", STARFOCUS_FIELD_FUNCTION},
           Row{"starfocus_observer", "on_block", "", STARFOCUS_FIELD_FUNCTION},
           Row{"starfocus_problem", "expected", "", STARFOCUS_FIELD_STRING},
           Row{"starfocus_tuning", "line_scan", "", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_light_field", "coverage", "", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_image", "planes", "", STARFOCUS_FIELD_POINTER},
           Row{"starfocus_config", "positions", "starfocus_position", STARFOCUS_FIELD_STRUCTURE},
       }) {
    CAPTURE(row.structure);
    CAPTURE(row.name);
    const starfocus_field* fields = nullptr;
    int32_t count = 0;
    REQUIRE(starfocus_fields(row.structure, &fields, &count) > 0);
    const auto* const field = std::find_if(
        fields, fields + count, [&](const auto& one) { return one.name == std::string(row.name); });
    REQUIRE(field != fields + count);
    CHECK(field->type == row.type);
    CHECK((field->structure == nullptr ? "" : field->structure) == std::string(row.target));
  }
}

TEST_CASE("the defaults match the documentation in the headers") {
  starfocus_config config;
  std::memset(&config, test::kPoison, sizeof config);
  starfocus_config_init(&config);
  CHECK(config.size == sizeof config);
  CHECK(config.max_blur == 32);
  CHECK(config.superblock == 0);
  CHECK(config.max_workers == 1);
  CHECK(config.tuning == nullptr);
  CHECK(config.unknown == STARFOCUS_UNKNOWN_REFUSE);
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  CHECK(tuning.line_scan == nullptr);
  CHECK(tuning.max_layer == 2);
  CHECK(tuning.deblocking == 35);
  CHECK(tuning.n_scale == 1);
  CHECK(tuning.gather == 1);
  CHECK(config.transfer == STARFOCUS_TRANSFER_SRGB);
  CHECK(config.highlights == 1);
  CHECK(config.features == STARFOCUS_FEATURE_COVERAGE);
  starfocus_study study;
  starfocus_study_init(&study);
  CHECK(study.mode == STARFOCUS_MODE_BLOCK);
  CHECK(study.renderer == STARFOCUS_RENDERER_AUTO);
  starfocus_params params;
  std::memset(&params, test::kPoison, sizeof params);
  starfocus_params_init(&params);
  CHECK(params.size == sizeof params);
  CHECK(params.study == nullptr);
  CHECK(params.aperture == 1);
  CHECK(params.focus == 0);
  CHECK(params.focus_nearer == 0);
  CHECK(params.focus_farther == 0);
  CHECK(params.shape == STARFOCUS_SHAPE_FALL_OFF);
  CHECK(params.theta == doctest::Approx(0.26 * 3.14159265358979).epsilon(1e-12));
  CHECK(params.blades == 5);
  CHECK(params.rotation == 0);
  CHECK(params.curvature == 0);
  CHECK(params.ring_inner == 0.5);
  CHECK(params.cats_eye == 0);
  CHECK(params.region.width == 0);
}

TEST_CASE("starfocus_view_position returns the documented positions for star sets of views") {
  const double kExpected[STARFOCUS_MAX_VIEWS][2] = {
      {0, 0},    {1, 0},     {-1, 0},     {0, 1},      {0, -1},     {1, 1},
      {-1, 1},   {1, -1},    {-1, -1},    {0.5, 0},    {-0.5, 0},   {0, 0.5},
      {0, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  double u = 7, v = 7;
  CHECK(starfocus_view_position(-1, &u, &v, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_view_position(STARFOCUS_MAX_VIEWS, &u, &v, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_view_position(INT32_MAX, &u, &v, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_view_position(INT32_MIN, &u, &v, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(starfocus_view_position(0, nullptr, &v, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_view_position(0, &u, nullptr, nullptr) == STARFOCUS_ERROR_NULL);
  CHECK(u == 7);
  CHECK(v == 7);
  for (int i = 0; i < STARFOCUS_MAX_VIEWS; ++i) {
    CAPTURE(i);
    REQUIRE(starfocus_view_position(i, &u, &v, nullptr) == STARFOCUS_OK);
    CHECK(u == kExpected[i][0]);
    CHECK(v == kExpected[i][1]);
  }
}

TEST_CASE("starfocus_simd_target returns a name that is not empty") {
  REQUIRE(starfocus_simd_target() != nullptr);
  CHECK(*starfocus_simd_target() != '\0');
}

}  // namespace facts_test
