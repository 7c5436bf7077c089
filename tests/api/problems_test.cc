// SPDX-License-Identifier: Apache-2.0
// Tests the fields, values and ranges of problems that refusals_bytes_test.cc does not compare, and
// the sizes of planes.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.h"
#include "tests/api/refusals.h"

namespace problems_test {
namespace {

using namespace refusals;

const starfocus_problem& Run(Call* call, starfocus_status status) {
  CHECK(call->Run() == status);
  return *starfocus_engine_problem(call->engine);
}

TEST_CASE("problem: a wrong size is reported with the smallest and the library's size") {
  starfocus_config config;
  starfocus_problem problem;
  size_t bytes = 0;
  for (const uint32_t size : {4u, 9u, 12u, uint32_t(sizeof config) + 8}) {
    starfocus_config_init(&config);
    config.size = size;
    CHECK(starfocus_workspace_size(&config, &bytes, &problem) == STARFOCUS_ERROR_STRUCTURE);
    CHECK(problem.field == std::string("config.size"));
    CHECK(problem.value == size);
    CHECK(problem.low == 8);
    CHECK(problem.high == sizeof config);
  }
}

TEST_CASE("problem: memory that is not aligned is named, and has no number") {
  Fixture f(false);
  Call prepare(&f, kPrepare);
  prepare.memory += 8;
  const starfocus_problem& memory = Run(&prepare, STARFOCUS_ERROR_WORKSPACE);
  CHECK(memory.field == std::string("memory"));
  CHECK(std::isnan(memory.value));
  Call refocus(&f, kRefocus);
  refocus.field.depth.data = static_cast<const char*>(refocus.field.depth.data) + 1;
  CHECK(Run(&refocus, STARFOCUS_ERROR_STRIDE).field == std::string("depth.data"));
  std::vector<float> map(4 * 4 + 1);
  starfocus_problem problem;
  CHECK(starfocus_fill_disparity(reinterpret_cast<float*>(reinterpret_cast<char*>(map.data()) + 1),
                                 16, 4, 4, &problem) == STARFOCUS_ERROR_STRIDE);
  CHECK(problem.field == std::string("disparity"));
}

TEST_CASE("problem: the ranges of preview_shift and rows are those of the header") {
  Fixture f(false);
  Call preview(&f, kPreview);
  preview.params.preview_shift = 3;
  const starfocus_problem shift = Run(&preview, STARFOCUS_ERROR_PREPARED);
  CHECK(shift.field == std::string("preview_shift"));
  CHECK(shift.low == 0);
  CHECK(shift.high == 2);
  Call pull(&f, kPull);
  pull.rows = -1;
  const starfocus_problem rows = Run(&pull, STARFOCUS_ERROR_RANGE);
  CHECK(rows.expected == std::string("at least 0"));
  CHECK(rows.high >= STARFOCUS_MAX_SIZE);
  Call push(&f, kPush);
  push.rows = kHeight + 1;
  CHECK(Run(&push, STARFOCUS_ERROR_RANGE).high == kHeight);
}

TEST_CASE("problem: an engine in place of a prepared light field is reported as such") {
  Fixture f(false);
  for (const unsigned function : {unsigned{kPrepared}, unsigned{kPreview}}) {
    Call call(&f, function);
    call.prepared = reinterpret_cast<starfocus_prepared*>(f.engine.get());
    const starfocus_problem& problem = Run(&call, STARFOCUS_ERROR_PREPARED);
    CHECK(problem.field == std::string("prepared"));
    CHECK(problem.expected == std::string("prepared with the engine's size, views, positions, "
                                          "disparity range, max_layer and transfer"));
  }
}

TEST_CASE("problem: starfocus_map_workspace_size accepts 0 and 1 as `repairs`") {
  starfocus_config config;
  starfocus_config_init(&config);
  config.width = config.height = 16;
  config.disparity_max = 4;
  starfocus_problem problem;
  size_t bytes = 0;
  for (const int32_t repairs : {-1, 0, 1, 2}) {
    const bool good = repairs == 0 || repairs == 1;
    CHECK((starfocus_map_workspace_size(&config, repairs, &bytes, &problem) == STARFOCUS_OK) ==
          good);
    CHECK(problem.field == std::string(good ? "" : "repairs"));
  }
}

TEST_CASE("stream: calls with wrong arguments do not end a stream, and accepted calls do") {
  Fixture f(false);
  const auto check = [&](unsigned function, auto&& spoil, starfocus_status status, bool ends) {
    CAPTURE(function);
    Call other(&f, function), pull(&f, kPull);
    spoil(&other);
    CHECK(other.Run() == status);
    CHECK(pull.Run() == (ends ? STARFOCUS_ERROR_STATE : STARFOCUS_OK));
    CHECK(pull.count == (ends ? 0 : kHeight));
  };
  for (const unsigned function : {kRefocus, kPrepared, kPreview, kPrepare}) {
    check(
        function, [](Call*) {}, STARFOCUS_OK, true);
    check(
        function, [](Call* c) { c->out_at = nullptr, c->field_at = nullptr; }, STARFOCUS_ERROR_NULL,
        false);
    if (function == kPrepare) continue;
    check(
        function, [](Call* c) { c->params.focus = 6.5; }, STARFOCUS_ERROR_BLUR, false);
  }
  float& disparity = f.scene.Disparity(7, 3);
  const float good = disparity;
  for (const unsigned function : {kRefocus, kPrepare}) {
    const auto spoil = [&](Call*) { disparity = 100; };
    check(function, spoil, STARFOCUS_ERROR_DISPARITY, true);
    disparity = good;
  }
}

TEST_CASE("starfocus_plane_size returns 0 for planes that the format does not have") {
  struct Row {
    starfocus_format format;
    int32_t rows[3];
    size_t row_bytes[3];
  };
  const Row rows[] = {{STARFOCUS_FORMAT_RGB, {5, 0, 0}, {21, 0, 0}},
                      {STARFOCUS_FORMAT_BGRX, {5, 0, 0}, {28, 0, 0}},
                      {STARFOCUS_FORMAT_NV12, {5, 3, 0}, {7, 8, 0}},
                      {STARFOCUS_FORMAT_I420, {5, 3, 3}, {7, 4, 4}}};
  int32_t count = -1;
  size_t bytes = 0;
  starfocus_problem problem;
  for (const Row& row : rows) {
    starfocus_image image = {};
    image.format = row.format;
    for (int plane = 0; plane < 3; ++plane) {
      CAPTURE(row.format);
      CAPTURE(plane);
      CHECK(starfocus_plane_size(&image, plane, 7, 5, &count, &bytes, &problem) == STARFOCUS_OK);
      CHECK(count == row.rows[plane]);
      CHECK(bytes == row.row_bytes[plane]);
    }
    for (const int32_t plane : {-1, 3}) {
      CHECK(starfocus_plane_size(&image, plane, 7, 5, &count, &bytes, &problem) ==
            STARFOCUS_ERROR_RANGE);
      CHECK(problem.field == std::string("plane"));
    }
  }
}

}  // namespace
}  // namespace problems_test
