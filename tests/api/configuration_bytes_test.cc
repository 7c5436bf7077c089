// SPDX-License-Identifier: Apache-2.0
// Tests illegal and extreme configurations, workspaces and outputs. refusals_bytes_test.cc tests
// the arguments of the functions that refocus, prepare and stream. For each illegal value, the
// error must name the field with this value, and the call must not write to the output.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/api/calls.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace configuration_bytes_test {
namespace {

using namespace calls;

constexpr int kWidth = 20, kHeight = 12;

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 17, -2, 2, 1);
  test::Config config = test::ConfigFor(scene, 8);
  starfocus::Params params = test::Params(0.5);
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight, 4};
};

Field FieldOf(test::Config* config, const std::string& path) {
  return FieldAt("starfocus_config", static_cast<starfocus_config*>(config), path);
}

// Checks that no function accepts a configuration, and that none writes anything. Returns the
// problem.
starfocus_problem Refused(const test::Config& config, const std::string& field) {
  static const Fixture f;
  static test::Engine legal(f.config);
  CAPTURE(field);
  starfocus_problem problem = {};
  size_t bytes = 4711;
  CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_ERROR_RANGE);
  CHECK(bytes == 4711);
  starfocus_engine* engine = legal.get();
  const std::vector<uint8_t> before(legal.workspace(), legal.workspace() + legal.bytes());
  CHECK(starfocus_init(&config, legal.workspace(), legal.bytes(), &engine, &problem) ==
        STARFOCUS_ERROR_RANGE);
  CheckProblem(&problem, STARFOCUS_ERROR_RANGE, field);
  CHECK(engine == nullptr);
  CHECK(std::memcmp(before.data(), legal.workspace(), before.size()) == 0);
  return problem;
}

// Numeric fields, their smallest and their largest legal values.
const struct Range {
  std::string path;
  double low, high;
} kRanges[] = {
    {"width", 1, STARFOCUS_MAX_SIZE},
    {"height", 1, STARFOCUS_MAX_SIZE},
    {"disparity_min", -STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY},
    {"disparity_max", -STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY},
    {"max_workers", 1, STARFOCUS_MAX_WORKERS},
    {"tuning.max_layer", 0, STARFOCUS_LAYERS - 1},
    {"tuning.deblocking", 0, 255},
    {"tuning.gather", 0, 1},
    {"tuning.n_scale", STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE},
    {"tuning.timing.block", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.field", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.a", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.b", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.c", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.upsample", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.span", 0, STARFOCUS_MAX_TIMING},
    {"tuning.timing.hole", 0, STARFOCUS_MAX_TIMING},
    {"unknown", 0, STARFOCUS_UNKNOWN_FILL},
    {"previews", 0, STARFOCUS_MAX_PREVIEW},
    {"transfer", 0, STARFOCUS_TRANSFER_NONE},
    {"highlights", 1, STARFOCUS_MAX_HIGHLIGHTS},
};

// Values that are illegal although they lie between legal values, or that have no closed range.
const struct Values {
  std::string path;
  std::vector<double> values;
} kBadValues[] = {
    {"views", {0, -1, 2, 16, 18}},
    {"superblock", {1, -64, 16, 48, 512}},
    {"max_blur", {0, -1, 128.5, kNan, kInf}},
    {"features", {64, 0x80000000}},
};

TEST_CASE("configuration: values at the ends of a range are legal, and values beyond are named") {
  size_t bytes = 0;
  for (const Range& row : kRanges) {
    CAPTURE(row.path);
    test::Config config;
    config.width = config.height = 20;
    config.disparity_min = -STARFOCUS_MAX_DISPARITY;
    config.disparity_max = STARFOCUS_MAX_DISPARITY;
    Field field = FieldOf(&config, row.path);
    for (const double limit : {row.low, row.high}) {
      field.Set(limit);
      CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    }
    for (const double value : Outside(field.type, row.low, row.high)) {
      field.Set(value);
      const starfocus_problem problem = Refused(config, row.path);
      CheckRange(&problem, row.path, value, row.low, row.high);
    }
  }
}

TEST_CASE("configuration: illegal values between legal values are rejected and named") {
  const Fixture f;
  for (const Values& row : kBadValues) {
    for (const double value : row.values) {
      test::Config config = f.config;
      FieldOf(&config, row.path).Set(value);
      const double named = Refused(config, row.path).value;
      CHECK((named == value || std::isnan(value)));
    }
  }
  test::Config config = f.config;
  config.disparity_min = 5;  // above disparity_max
  CHECK(Refused(config, "disparity_max").low == 5);
  size_t bytes = 0;
  starfocus_problem problem;
  for (const int32_t repairs : {-1, 0, 1, 2}) {
    const bool good = repairs == 0 || repairs == 1;
    CHECK((starfocus_map_workspace_size(&f.config, repairs, &bytes, &problem) == STARFOCUS_OK) ==
          good);
    CHECK(problem.field == std::string(good ? "" : "repairs"));
  }
}

TEST_CASE("configuration: bad positions of views are rejected and named") {
  const struct {
    std::string field;  // "" if the positions are legal
    starfocus_position positions[2];
  } rows[] = {
      {"", {{0, 0}, {-1, 1}}},
      // Without positions, a light field of two views is illegal, since no star set has two views.
      {"views", {{0, 0}, {0, 0}}},
      {"positions[].u", {{0, 0}, {1.5, 0}}},
      {"positions[].v", {{0, 0}, {0, kNan}}},
      {"positions[]", {{0.5, 0}, {1, 0}}},
  };
  for (const auto& row : rows) {
    test::Config config = Fixture().config;
    config.views = 2;
    std::copy_n(row.positions, 2, config.positions);
    size_t bytes = 0;
    if (!row.field.empty())
      Refused(config, row.field);
    else
      CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  }
}

TEST_CASE("configuration: null pointers and uninitialized structures are rejected") {
  Fixture f;
  test::Engine legal(f.config);
  uint8_t* const memory = legal.workspace();
  size_t bytes = legal.bytes();
  starfocus_engine* engine = nullptr;
  starfocus_problem problem;
  const auto check = [&](starfocus_status found, starfocus_status expected, const char* field) {
    CHECK(found == expected);
    CheckProblem(&problem, expected, field);
  };
  constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kStructure = STARFOCUS_ERROR_STRUCTURE;
  const starfocus_config zero = {};
  const starfocus_tuning tuning = {};
  starfocus_config tuned = f.config;
  tuned.tuning = &tuning;
  check(starfocus_workspace_size(nullptr, &bytes, &problem), kNull, "config");
  check(starfocus_workspace_size(&f.config, nullptr, &problem), kNull, "bytes");
  check(starfocus_workspace_size(&zero, &bytes, &problem), kStructure, "config.size");
  check(starfocus_workspace_size(&tuned, &bytes, &problem), kStructure, "tuning.size");
  check(starfocus_init(nullptr, memory, bytes, &engine, &problem), kNull, "config");
  check(starfocus_init(&f.config, nullptr, bytes, &engine, &problem), kNull, "workspace");
  check(starfocus_init(&f.config, memory, bytes, nullptr, &problem), kNull, "engine");
  CHECK(starfocus_init(nullptr, nullptr, 0, nullptr, nullptr) == kNull);
  starfocus_config_init(nullptr);
  starfocus_params_init(nullptr);
}

TEST_CASE("configuration: all limits together are legal") {
  test::Config config;
  config.width = config.height = STARFOCUS_MAX_SIZE;
  config.views = STARFOCUS_MAX_VIEWS;
  config.disparity_min = -STARFOCUS_MAX_DISPARITY;
  config.disparity_max = STARFOCUS_MAX_DISPARITY;
  config.max_blur = STARFOCUS_MAX_BLUR;
  config.superblock = 256;
  config.max_workers = STARFOCUS_MAX_WORKERS;
  config.features |= STARFOCUS_FEATURE_STREAMING | STARFOCUS_FEATURE_SHAPES;
  config.highlights = STARFOCUS_MAX_HIGHLIGHTS;
  size_t bytes = 0;
  // The workspace for all limits together exceeds a 32-bit address space.
  const starfocus_status legal = sizeof(size_t) == 4 ? STARFOCUS_ERROR_TOO_LARGE : STARFOCUS_OK;
  CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == legal);
  CHECK((bytes > 0) == (legal == STARFOCUS_OK));
}

TEST_CASE("configuration: superblock = 0 selects 128 pixels") {
  for (const int width : {1, 1700}) {
    CAPTURE(width);
    const test::Scene scene = test::RandomScene(width, 3, 1, -2, 2, 9);
    test::Config config = test::ConfigFor(scene, 4);
    config.superblock = 0;
    test::Report report;
    test::OutputOf(config, test::Params(1, 1, STARFOCUS_MODE_BLOCK), scene, &report);
    CHECK(report.superblock == 128);
  }
}

TEST_CASE("workspace: memory that is too small or misaligned is rejected") {
  Fixture f;
  test::Engine legal(f.config);
  REQUIRE(legal.status() == STARFOCUS_OK);
  const size_t bytes = legal.bytes();
  std::vector<uint8_t> larger(bytes + 2 * STARFOCUS_ALIGNMENT);
  const size_t address = reinterpret_cast<uintptr_t>(larger.data());
  uint8_t* const aligned = larger.data() + STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT;
  const auto init = [&](uint8_t* memory, size_t size) {
    starfocus_engine* engine = legal.get();
    const starfocus_status status = starfocus_init(&f.config, memory, size, &engine, nullptr);
    CHECK((engine == nullptr) == (status != STARFOCUS_OK));
    return status;
  };
  for (const size_t size : {size_t{0}, size_t{1}, size_t{64}, bytes / 2, bytes - 1}) {
    CHECK(init(aligned, size) == STARFOCUS_ERROR_WORKSPACE);
  }
  for (const int offset : {1, 2, 8, 16, 32, 63}) {
    CHECK(init(aligned + offset, bytes) == STARFOCUS_ERROR_WORKSPACE);
  }
  CHECK(init(aligned, bytes) == STARFOCUS_OK);
  CHECK(init(aligned, bytes + 64) == STARFOCUS_OK);
}

TEST_CASE("refocus: output may be adjacent to the inputs, but must not overlap them") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  const size_t stride = 3 * kWidth;
  const auto run = [&](void* out) {
    return test::RefocusRgb(engine.get(), &f.params, &f.field, static_cast<uint8_t*>(out), stride,
                            nullptr);
  };
  // The disparity map ends with the last byte of its last row, so an output may start at the next
  // byte.
  std::vector<float> map(size_t(kWidth * kHeight) + stride * kHeight);
  std::copy(f.scene.disparity.begin(), f.scene.disparity.end(), map.begin());
  f.field.depth.data = map.data();
  uint8_t* const behind = reinterpret_cast<uint8_t*>(map.data() + kWidth * kHeight);
  for (const size_t bytes : {size_t{1}, size_t{3}, size_t{kWidth}, stride - 1, stride}) {
    CHECK(run(behind - bytes) == STARFOCUS_ERROR_OVERLAP);
  }
  CHECK(run(behind) == STARFOCUS_OK);

  // An output that is adjacent to an input picture does not overlap the input.
  std::vector<uint8_t> joined(3 * stride * kHeight, test::kPoison);
  uint8_t* view = joined.data() + stride * kHeight;
  std::memcpy(view, f.scene.pictures[0].data(), stride * kHeight);
  f.field.views[0].planes[0] = view;
  CHECK(run(joined.data()) == STARFOCUS_OK);
  CHECK(run(joined.data() + 2 * stride * kHeight) == STARFOCUS_OK);
  CHECK(run(joined.data() + 1) == STARFOCUS_ERROR_OVERLAP);
}

}  // namespace
}  // namespace configuration_bytes_test
