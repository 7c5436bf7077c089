// SPDX-License-Identifier: Apache-2.0
// Tests a table of illegal arguments for the functions that refocus, prepare and stream pictures.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "starfocus/starfocus.hpp"
#include "tests/api/illegal_values.h"
#include "tests/api/refusals.h"

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
