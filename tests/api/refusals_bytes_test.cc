// SPDX-License-Identifier: Apache-2.0
// Tests a table of illegal arguments for the functions that refocus, prepare and stream pictures.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/api/illegal_values.h"
#include "tests/api/refusals.h"
#include "tests/support/config.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"

namespace refusals_bytes_test {
namespace {

using namespace refusals;
using namespace illegal_values;

struct Row {
  unsigned functions;
  const char* field;
  starfocus_status status;
  void (*spoil)(Call*);
};

constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kStructure = STARFOCUS_ERROR_STRUCTURE,
                           kRange = STARFOCUS_ERROR_RANGE, kStride = STARFOCUS_ERROR_STRIDE,
                           kOverlap = STARFOCUS_ERROR_OVERLAP, kFeature = STARFOCUS_ERROR_FEATURE,
                           kOk = STARFOCUS_OK, kWorkspace = STARFOCUS_ERROR_WORKSPACE,
                           kOther = STARFOCUS_ERROR_PREPARED;

void PutOut(Call* c, const void* to) {
  c->out.planes[0] = static_cast<uint8_t*>(const_cast<void*>(to));
}
uint8_t* LastOf(test::Engine* engine) { return engine->workspace() + engine->bytes() - 1; }

const Row kPictures[] = {
    {kAll, "", kOk, [](Call*) {}},
    {kAll, "", kNull, [](Call* c) { c->engine = nullptr; }},
    {kTakesParams, "params", kNull, [](Call* c) { c->params_at = nullptr; }},
    {kTakesField, "light_field", kNull, [](Call* c) { c->field_at = nullptr; }},
    {kTakesOut, "out", kNull, [](Call* c) { c->out_at = nullptr; }},
    {kTakesOut, "out.planes", kNull, [](Call* c) { c->out.planes[0] = nullptr; }},
    {kPrepared | kPreview, "prepared", kNull, [](Call* c) { c->prepared = nullptr; }},
    {kPrepare, "prepared", kNull, [](Call* c) { c->made_at = nullptr; }},
    {kPrepare, "memory", kNull, [](Call* c) { c->memory = nullptr; }},
    {kPush, "consumed", kNull, [](Call* c) { c->count_at = nullptr; }},
    {kPull, "written", kNull, [](Call* c) { c->count_at = nullptr; }},

    {kPush | kPull, "rows", kRange, [](Call* c) { c->rows = -1; }},
    {kPush | kPull, "rows", kRange, [](Call* c) { c->rows = INT32_MIN; }},
    {kPush, "rows", kRange, [](Call* c) { c->rows = kHeight + 1; }},
    {kPush, "rows", kRange, [](Call* c) { c->rows = INT32_MAX; }},
    {kPrepare, "bytes", kWorkspace, [](Call* c) { --c->bytes; }},
    {kPrepare, "memory", kWorkspace, [](Call* c) { c->memory += 8; }},
    {kTakesOut, "out.strides", kStride, [](Call* c) { c->out.strides[0] = 0; }},
    {kTakesOut, "out.strides", kStride, [](Call* c) { c->out.strides[0] = 1; }},
    {kTakesOut & ~kPreview, "out.strides", kStride, [](Call* c) { c->out.strides[0] = 59; }},
    {kPreview, "out.strides", kStride, [](Call* c) { c->out.strides[0] = 29; }},
    {kTakesOut, "out.strides", kStride, [](Call* c) { c->out.strides[0] = kHuge; }},
    {kTakesOut, "out.strides", kStride, [](Call* c) { c->out.strides[0] = kHuge / 4; }},

    {kPrepare, "memory", kOverlap, [](Call* c) { c->memory = c->f.engine.workspace(); }},
    {kPrepare, "memory", kOverlap, [](Call* c) { c->field.depth.data = c->memory; }},
    {kTakesOut, "out", kOverlap, [](Call* c) { PutOut(c, c->f.engine.workspace()); }},
    {kTakesOut, "out", kOverlap, [](Call* c) { PutOut(c, LastOf(&c->f.engine)); }},
    {kPrepared | kPreview, "out", kOverlap,
     [](Call* c) { PutOut(c, c->f.memory.get() + c->f.memory.bytes - 1); }},
    {kRefocus | kAfter, "out", kOverlap, [](Call* c) { PutOut(c, c->f.scene.pictures[0].data()); }},
    {kRefocus | kAfter, "out", kOverlap,
     [](Call* c) { PutOut(c, &c->f.scene.pictures[16].back()); }},
    {kRefocus | kAfter, "out", kOverlap, [](Call* c) { PutOut(c, c->f.scene.disparity.data()); }},
    {kRefocus | kAfter, "out", kOverlap, [](Call* c) { PutOut(c, &c->f.scene.disparity.back()); }},

    {kAfter, "previous.size", kStructure, [](Call* c) { c->before.size = 0; }},
    {kAfter, "previous.light_field", kNull, [](Call* c) { c->before.light_field = nullptr; }},
    {kAfter, "previous.out", kNull, [](Call* c) { c->before.out = nullptr; }},
    {kAfter, "previous.light_field.size", kStructure, [](Call* c) { c->field_before.size = 0; }},
    {kTakesField, "light_field.size", kStructure, [](Call* c) { c->field.size = 0; }},
    {kRefocus | kAfter | kPrepared | kPreview | kPull, "report.size", kStructure,
     [](Call* c) { c->report.size = 0; }},
    {kAfter, "previous.out.planes", kNull, [](Call* c) { c->out_before.planes[0] = nullptr; }},
    {kAfter, "previous.out.strides", kStride, [](Call* c) { c->out_before.strides[0] = 59; }},
    {kAfter, "previous.light_field.views[].planes", kNull,
     [](Call* c) { c->field_before.views[4].planes[0] = nullptr; }},
    {kAfter, "previous.light_field.depth.stride", kStride,
     [](Call* c) { c->field_before.depth.stride = 4; }},
    {kAfter, "out", kOverlap, [](Call* c) { PutOut(c, c->picture_before.Colour(1, 0, 0)); }},
    {kAfter, "out", kOverlap,
     [](Call* c) {
       c->field_before = c->f.image.converted.Field();
       PutOut(c, c->f.image.converted.pictures[2].data());
     }},
    {kAfter, "previous.out.format", kRange, [](Call* c) { c->out_before.format = 99; }},
    {kAfter, "out.format", kFeature, [](Call* c) { c->out.format = STARFOCUS_FORMAT_BGR; }},
    {kAfter, "previous.out.pixel_stride", kRange, [](Call* c) { c->out_before.pixel_stride = 2; }},
    {kAfter, "previous.light_field.coverage_stride", kStride,
     [](Call* c) {
       c->field_before.coverage = c->f.scene.pictures[0].data();
       c->field_before.coverage_stride = 19;
     }},
    {kAfter, "previous.out.format", kFeature,
     [](Call* c) { c->out_before.format = STARFOCUS_FORMAT_BGR; }},
    {kAfter, "previous.light_field.views[].format", kFeature,
     [](Call* c) { c->field_before.views[2].format = STARFOCUS_FORMAT_BGR; }},
    {kAfter, "previous.light_field.depth", kFeature,
     [](Call* c) { c->field_before.depth.scale = 2; }},
    {kPrepared | kPreview | kBegin, "previous", kRange,
     [](Call* c) { c->params.previous = &c->before; }},
    {kPreview, "preview_shift", kOther, [](Call* c) { c->params.preview_shift = -1; }},
    {kPreview, "preview_shift", kOther, [](Call* c) { c->params.preview_shift = 3; }},
    {kPreview, "preview_shift", kOther, [](Call* c) { c->params.preview_shift = 32; }},

    // Arguments that only an engine without STARFOCUS_FEATURE_IMAGES rejects.
    {kTakesField, "views[].format", kFeature,
     [](Call* c) {
       c->engine = c->f.plain.get();
       c->field.views[0].format = STARFOCUS_FORMAT_BGR;
     }},
    {kTakesField, "depth", kFeature,
     [](Call* c) {
       c->engine = c->f.plain.get();
       c->field.depth.type = STARFOCUS_DEPTH_U8;
     }},
    {kTakesOut, "out.format", kFeature,
     [](Call* c) {
       c->engine = c->f.plain.get();
       c->out.format = STARFOCUS_FORMAT_BGR;
     }},

    // Output pictures must be exactly as large as the region.
    {kBegin, "region", kRange,
     [](Call* c) {
       c->params.region = {0, 0, 20, kHeight};
     }},
    {kRefocus | kPrepared, "out.strides", kStride,
     [](Call* c) {
       c->params.region = {3, 4, 5, 6};
       c->out.strides[0] = 14;
     }},
    {kRefocus | kPrepared, "", kOk,
     [](Call* c) {
       c->params.region = {3, 4, 5, 6};
       c->out.strides[0] = 15;
     }},
    {kRefocus | kPrepared, "out", kOverlap,
     [](Call* c) {
       c->params.region = {3, 4, 5, 6};
       c->out.strides[0] = 15;
       PutOut(c, c->f.engine.workspace() - 1);
     }},
};

// All views and the output are images of 21x12 pixels. View 0 is R, G, B. Views 1 and 4 are NV12.
// View 2 and the output are I420.
constexpr unsigned kViews = kRefocus | kPrepare | kPush, kOuts = kRefocus | kPrepared | kPull;
const Row kImages[] = {
    {kAll & ~kAfter, "", kOk, [](Call*) {}},
    {kViews, "views[].format", kRange, [](Call* c) { c->field.views[0].format = -1; }},
    {kViews, "views[].format", kRange, [](Call* c) { c->field.views[4].format = 8; }},
    {kOuts | kPreview, "out.format", kRange, [](Call* c) { c->out.format = 99; }},
    {kViews, "views[].matrix", kRange, [](Call* c) { c->field.views[1].matrix = 2; }},
    {kOuts, "out.matrix", kRange, [](Call* c) { c->out.matrix = -1; }},
    {kOuts, "out.range", kRange, [](Call* c) { c->out.range = 2; }},
    {kViews, "views[].range", kRange, [](Call* c) { c->field.views[1].range = -1; }},
    {kViews, "views[].planes", kNull, [](Call* c) { c->field.views[1].planes[0] = nullptr; }},
    {kViews, "views[].planes", kNull, [](Call* c) { c->field.views[1].planes[1] = nullptr; }},
    {kOuts, "out.planes", kNull, [](Call* c) { c->out.planes[2] = nullptr; }},
    // NV12 has two planes.
    {kViews, "", kOk, [](Call* c) { c->field.views[1].planes[2] = nullptr; }},
    {kViews, "views[].strides", kStride, [](Call* c) { c->field.views[1].strides[0] = 20; }},
    {kViews, "views[].strides", kStride, [](Call* c) { c->field.views[1].strides[1] = 21; }},
    {kOuts, "out.strides", kStride, [](Call* c) { c->out.strides[2] = 10; }},
    {kOuts, "out.strides", kStride, [](Call* c) { c->out.strides[0] = SIZE_MAX / 2; }},
    {kViews, "views[].pixel_stride", kRange, [](Call* c) { c->field.views[1].pixel_stride = 1; }},
    {kViews, "", kOk, [](Call* c) { c->field.views[1].pixel_stride = 2; }},
    {kOuts, "out.pixel_stride", kRange, [](Call* c) { c->out.pixel_stride = 2; }},
    {kViews, "views[].pixel_stride", kRange, [](Call* c) { c->field.views[0].pixel_stride = 2; }},
    {kViews, "views[].pixel_stride", kRange, [](Call* c) { c->field.views[0].pixel_stride = -3; }},
    {kViews, "views[].pixel_stride", kRange, [](Call* c) { c->field.views[0].pixel_stride = 257; }},
    {kViews, "views[].strides", kStride, [](Call* c) { c->field.views[0].pixel_stride = 4; }},
    {kViews, "views[].pixel_stride", kRange,
     [](Call* c) {
       c->field.views[0].format = STARFOCUS_FORMAT_RGBX;
       c->field.views[0].pixel_stride = 3;
     }},
    {kViews, "views[].strides", kStride,
     [](Call* c) {
       c->field.views[0].format = STARFOCUS_FORMAT_RGBX;
       c->field.views[0].strides[0] = 4 * 21 - 1;
     }},
    {kViews, "depth.data", kNull, [](Call* c) { c->field.depth.data = nullptr; }},
    {kViews, "depth.type", kRange, [](Call* c) { c->field.depth.type = 5; }},
    {kViews, "depth.type", kRange, [](Call* c) { c->field.depth.type = -1; }},
    {kViews, "depth.meaning", kRange, [](Call* c) { c->field.depth.meaning = 2; }},
    {kViews, "depth.meaning", kRange, [](Call* c) { c->field.depth.meaning = -1; }},
    {kViews, "depth.has_invalid", kRange, [](Call* c) { c->field.depth.has_invalid = 2; }},
    {kViews, "depth.scale", kRange, [](Call* c) { c->field.depth.scale = 0; }},
    {kViews, "depth.scale", kRange, [](Call* c) { c->field.depth.scale = kNanF; }},
    {kViews, "depth.offset", kRange, [](Call* c) { c->field.depth.offset = kNanF; }},
    {kViews, "depth.width", kRange, [](Call* c) { c->field.depth.width = 22; }},
    {kViews, "depth.height", kRange, [](Call* c) { c->field.depth.height = kHeight + 1; }},
    {kViews, "depth.width", kRange, [](Call* c) { c->field.depth.width = 0; }},
    {kViews, "depth.height", kRange, [](Call* c) { c->field.depth.height = -1; }},
    {kViews, "depth.stride", kStride, [](Call* c) { c->field.depth.stride = 2 * 10 - 2; }},
    {kViews, "depth.stride", kStride, [](Call* c) { c->field.depth.stride += 1; }},
    {kViews, "depth.data", kStride,  // an odd address
     [](Call* c) { c->field.depth.data = static_cast<const char*>(c->field.depth.data) + 1; }},
    {kOuts | kPreview, "out", kOverlap, [](Call* c) { PutOut(c, c->f.engine.workspace()); }},
    {kPrepare, "bytes", kWorkspace, [](Call* c) { --c->bytes; }},
    {kPrepare, "memory", kOverlap, [](Call* c) { c->field.depth.data = c->memory; }},
    {kRefocus, "out", kOverlap, [](Call* c) { PutOut(c, c->field.views[0].planes[0]); }},
    {kRefocus, "out", kOverlap,
     [](Call* c) { c->out.planes[2] = static_cast<uint8_t*>(c->field.views[1].planes[1]) + 30; }},
    {kRefocus, "out", kOverlap,
     [](Call* c) {
       c->out.planes[1] = static_cast<uint8_t*>(const_cast<void*>(c->field.depth.data)) + 40;
     }},
};

constexpr int kMost = std::numeric_limits<int32_t>::max(), kLeast = -kMost - 1;
const std::pair<const char*, starfocus_region> kBadRegions[] = {
    {"region.height", {0, 0, 1, 0}},
    {"region.width", {0, 0, 0, 1}},
    {"region.width", {1, 0, 0, 0}},
    {"region.x", {-1, 0, 4, 4}},
    {"region.y", {0, -1, 4, 4}},
    {"region.width", {0, 0, -1, 4}},
    {"region.height", {0, 0, 4, -1}},
    {"region.width", {0, 0, 21, 12}},
    {"region.height", {0, 0, 20, 13}},
    {"region.x", {20, 0, 1, 1}},
    {"region.y", {0, 12, 1, 1}},
    {"region.width", {19, 0, 2, 1}},
    {"region.x", {kMost, 0, 1, 1}},
    {"region.width", {1, 1, kMost, kMost}},
    {"region.x", {kLeast, kLeast, kMost, kMost}},
};

TEST_CASE("calls: null pointers and illegal pictures, memory, row counts and shifts are rejected") {
  Fixture pictures(false), images(true);
  for (const Row& row : kPictures)
    Check(&pictures, row.functions, row.spoil, row.status, row.field);
  for (const Row& row : kImages) Check(&images, row.functions, row.spoil, row.status, row.field);
}

TEST_CASE("calls: illegal parameters, light fields and regions are rejected") {
  Fixture f(false);
  for (const Bad<starfocus::Params>& bad : kBadParams) {
    const unsigned previews = std::string(bad.field) == "preview_shift" ? kPrepared | kPreview : 0;
    Check(
        &f, kTakesParams & ~previews, [&](Call* c) { bad.spoil(&c->params); }, bad.status,
        bad.field);
  }
  for (const Bad<starfocus_light_field>& bad : kBadFields) {
    Check(
        &f, kTakesField, [&](Call* c) { bad.spoil(&c->field); }, bad.status, bad.field);
  }
  for (const auto& [field, region] : kBadRegions) {
    const starfocus_region at = region;
    const auto spoil = [&](Call* c) { c->params.region = at; };
    Check(&f, kTakesParams & ~kBegin, spoil, kRange, field);
    Check(&f, kBegin, spoil, kRange, "region");  // a stream has no region
  }
}

TEST_CASE("calls: illegal disparity values are rejected at any position") {
  Fixture f(false);
  for (const float bad : {kNanF, kInfF, -kInfF, 2.0001f, -2.0001f, 3e38f, -3e38f}) {
    const bool finite = std::abs(bad) < kInfF;
    for (const int y : {0, kHeight / 2, kHeight - 1}) {
      for (const int x : {0, 7, 19}) {
        const float good = f.scene.Disparity(x, y);
        f.scene.Disparity(x, y) = bad;
        Check(
            &f, kRefocus | kAfter | kPrepare, [](Call*) {},
            finite ? STARFOCUS_ERROR_DISPARITY : STARFOCUS_ERROR_NOT_FINITE, "disparity");
        const starfocus_problem& problem = *starfocus_engine_problem(f.engine.get());
        CHECK(problem.x == x);
        CHECK(problem.y == y);
        CHECK((finite ? problem.value == double(bad) : problem.value != problem.value));
        f.scene.Disparity(x, y) = good;
      }
    }
  }
}

}  // namespace
}  // namespace refusals_bytes_test

// Tests the fields, values and ranges of problems that refusals_bytes_test.cc does not compare, and
// the sizes of planes.

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

// Tests the streaming functions with bad input and with calls in the wrong order.

namespace abi_stream_test {
namespace {

constexpr int kWidth = 20, kHeight = 90;

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 9, -2, 2, 3);
  test::Config config = test::ConfigFor(scene, 8);
  starfocus::Params params = test::Params(0.5);
  test::Output out{kWidth, kHeight, 4};

  Fixture() { config.features |= STARFOCUS_FEATURE_STREAMING; }

  starfocus_status Push(starfocus_engine* engine, const starfocus_light_field& field, int rows,
                        int32_t* consumed) {
    return starfocus_stream_push(engine, &field, rows, consumed);
  }
  starfocus_status Pull(starfocus_engine* engine, int rows, int32_t* written) {
    return test::PullRgb(engine, out.bytes.data(), out.stride, rows, written, nullptr);
  }
};

TEST_CASE("stream: calls fail without the streaming feature and without begin") {
  Fixture f;
  int32_t count = 0;
  {
    test::Engine engine(f.config);
    REQUIRE(engine.status() == STARFOCUS_OK);
    CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
    CHECK(f.Pull(engine.get(), 1, &count) == STARFOCUS_ERROR_STATE);
    // A rejected starfocus_stream_begin starts no stream.
    starfocus::Params params = f.params;
    params.aperture = 2;
    CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_ERROR_RANGE);
    CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
  }
  f.config.features &= ~STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  CHECK(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_ERROR_FEATURE);
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
  CHECK(f.Pull(engine.get(), 1, &count) == STARFOCUS_ERROR_STATE);
  CHECK(f.out.Untouched());
}

TEST_CASE("stream: push accepts at most as many rows as the picture has") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  int32_t count = -1;
  CHECK(f.Push(engine.get(), f.scene.Field(), kHeight + 1, &count) == STARFOCUS_ERROR_RANGE);
  // A rejected push consumes no row, so the whole picture can still be pushed.
  CHECK(f.Push(engine.get(), f.scene.Field(), 0, &count) == STARFOCUS_OK);
  CHECK(count == 0);
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_OK);
  CHECK(count == 1);
  CHECK(f.Push(engine.get(), f.scene.Field(1), kHeight, &count) == STARFOCUS_ERROR_RANGE);
}

TEST_CASE("stream: a row with a bad disparity is rejected, and the preceding rows are accepted") {
  Fixture f;
  test::Engine engine(f.config);
  const test::Scene good = f.scene;
  test::Output expected(kWidth, kHeight, 4);
  REQUIRE(test::Stream(&engine, f.params, good, &expected, 8, 8) == STARFOCUS_OK);
  const struct {
    float value;
    starfocus_status status;
  } kBad[] = {{std::numeric_limits<float>::quiet_NaN(), STARFOCUS_ERROR_NOT_FINITE},
              {std::numeric_limits<float>::infinity(), STARFOCUS_ERROR_NOT_FINITE},
              {2.5f, STARFOCUS_ERROR_DISPARITY}};
  for (const auto& bad : kBad) {
    for (int row : {0, 1, 3}) {
      CAPTURE(row);
      f.scene.Disparity(kWidth - 1, row) = bad.value;
      REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
      int32_t consumed = -1;
      CHECK(f.Push(engine.get(), f.scene.Field(), 5, &consumed) == bad.status);
      CHECK(consumed == row);
      CHECK(starfocus_engine_problem(engine.get())->x == kWidth - 1);
      CHECK(starfocus_engine_problem(engine.get())->y == row);
      // After a rejected row, the caller may correct the disparities of this row and continue.
      f.scene = good;
      test::Output out(kWidth, kHeight, 4);
      test::StreamSteps steps = {&engine, f.scene, &out, consumed};
      while (!steps.Ended()) REQUIRE(steps.Step() == STARFOCUS_OK);
      CHECK(out.bytes == expected.bytes);
    }
  }
}

TEST_CASE("stream: begin restarts a stream that was stopped halfway") {
  Fixture f;
  test::Engine engine(f.config);
  test::Output whole(kWidth, kHeight, 4);
  REQUIRE(test::Refocus(&engine, f.params, f.scene, &whole) == STARFOCUS_OK);
  // The test stops the stream halfway and then begins a new stream.
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  int32_t count = 0;
  REQUIRE(f.Push(engine.get(), f.scene.Field(), 40, &count) == STARFOCUS_OK);
  REQUIRE(f.Pull(engine.get(), 40, &count) == STARFOCUS_OK);
  test::Output streamed(kWidth, kHeight, 4);
  REQUIRE(test::Stream(&engine, f.params, f.scene, &streamed, 7, 9) == STARFOCUS_OK);
  CHECK(streamed.bytes == whole.bytes);
  // All rows have been pushed, so another push is rejected.
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_RANGE);
}

}  // namespace
}  // namespace abi_stream_test
