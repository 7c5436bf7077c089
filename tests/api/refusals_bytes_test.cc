// SPDX-License-Identifier: Apache-2.0
// Tests tables of illegal arguments for the functions that refocus, prepare and stream pictures. A
// call must return the expected status, name the illegal field, and write nothing.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/api/calls.h"
#include "tests/support/refocused.h"

namespace refusals_bytes_test {
namespace {

using namespace calls;

// Returns the name by which errors call the field with a path: "views[].planes" of
// "views[1].planes[0]".
std::string NameOf(const std::string& path) {
  const std::string field = std::regex_replace(path, std::regex("\\[\\d+\\]$"), "");
  return std::regex_replace(field, std::regex("\\[\\d+\\]"), "[]");
}

// Checks a call with an illegal argument, for each function of the set `functions`. If `path` has
// an index, the problem must report the index.
template <class Spoil>
void Check(Fixture* f, unsigned functions, const Spoil& spoil, starfocus_status status,
           const std::string& path) {
  const bool refused = status != STARFOCUS_OK;
  for (unsigned function = 1; function < kAll; function *= 2) {
    if ((functions & function) == 0) continue;
    CAPTURES(function, path);
    Call call(f, function);
    const test::Scene scene = f->scene;
    spoil(&call);
    CHECK(call.Run() == status);
    if (call.engine != nullptr) {
      const starfocus_problem* const problem = starfocus_engine_problem(call.engine);
      CheckProblem(problem, status, refused ? NameOf(path) : "");
      const size_t view = path.find("views[");
      if (refused && view != std::string::npos && path[view + 6] != ']') {
        CHECK(problem->index == std::atoi(path.c_str() + view + 6));
      }
    }
    CHECK(call.Untouched() == (refused || (function & kTakesOut) == 0));
    CHECK(f->scene.pictures == scene.pictures);
    CHECK(std::memcmp(f->scene.disparity.data(), scene.disparity.data(),
                      4 * scene.disparity.size()) == 0);
    if (function == kPrepare && call.made_at != nullptr) CHECK((call.made == nullptr) == refused);
    if (function == kPush || function == kPull) CHECK((call.count <= 0) == refused);
  }
}

constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kStructure = STARFOCUS_ERROR_STRUCTURE,
                           kRange = STARFOCUS_ERROR_RANGE, kStride = STARFOCUS_ERROR_STRIDE,
                           kOverlap = STARFOCUS_ERROR_OVERLAP, kFeature = STARFOCUS_ERROR_FEATURE,
                           kOk = STARFOCUS_OK, kWorkspace = STARFOCUS_ERROR_WORKSPACE,
                           kOther = STARFOCUS_ERROR_PREPARED;
constexpr unsigned kInPlace = kRefocus | kAfter;
// Functions whose arguments the fixture of images spoils.
constexpr unsigned kViews = kRefocus | kPrepare | kPush, kOuts = kRefocus | kPrepared | kPull;

// Numeric fields, their smallest and their largest legal values.
struct Range {
  unsigned functions;
  std::string path;
  double low, high;
};

const Range kLensRanges[] = {
    {kTakesParams, "study.mode", 0, STARFOCUS_MODE_BLUR},
    {kTakesParams, "study.renderer", 0, STARFOCUS_RENDERER_SLICES},
    {kTakesParams, "focus", -STARFOCUS_MAX_FOCUS, STARFOCUS_MAX_FOCUS},
    {kTakesParams, "focus_nearer", 0, STARFOCUS_MAX_FOCUS - 0.5},  // the focus is 0.5
    {kTakesParams, "focus_farther", 0, STARFOCUS_MAX_FOCUS + 0.5},
    {kTakesParams, "aperture", 0, 1},
    {kTakesParams, "shape", 0, STARFOCUS_SHAPE_RING},
    {kTakesParams, "blades", STARFOCUS_MIN_BLADES, STARFOCUS_MAX_BLADES},
    {kTakesParams, "theta", STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA},
    {kTakesParams, "rotation", -360, 360},
    {kTakesParams, "curvature", 0, 1},
    {kTakesParams, "ring_inner", 0, STARFOCUS_MAX_RING_INNER},
    {kTakesParams, "cats_eye", 0, 1},
    // A region of one pixel at (3, 4); streams have no region.
    {kTakesParams & ~kBegin, "region.x", 0, 19},
    {kTakesParams & ~kBegin, "region.y", 0, kHeight - 1},
    {kTakesParams & ~kBegin, "region.width", 1, 20 - 3},
    {kTakesParams & ~kBegin, "region.height", 1, kHeight - 4},
};

// All views and the output are images of 21x12 pixels. View 0 is R, G, B. Views 1 and 4 are NV12.
// View 2 and the output are I420.
const Range kImageRanges[] = {
    {kViews, "views[0].format", 0, STARFOCUS_FORMAT_YUV_420_888},
    {kViews, "views[1].matrix", 0, STARFOCUS_MATRIX_BT709},
    {kViews, "views[1].range", 0, STARFOCUS_RANGE_FULL},
    {kOuts | kPreview, "out.format", 0, STARFOCUS_FORMAT_YUV_420_888},
    {kOuts, "out.matrix", 0, STARFOCUS_MATRIX_BT709},
    {kOuts, "out.range", 0, STARFOCUS_RANGE_FULL},
    {kViews, "depth.type", 0, STARFOCUS_DEPTH_DEPTH16},
    {kViews, "depth.meaning", 0, STARFOCUS_DEPTH_RECIPROCAL},
    {kViews, "depth.has_invalid", 0, 1},
    {kViews, "depth.width", 1, 21},
    {kViews, "depth.height", 1, kHeight},
};

// Values of one or more fields that the functions reject, or accept if the status is kOk.
struct Values {
  unsigned functions;
  starfocus_status status;
  std::vector<std::string> paths;
  std::vector<double> values;
};

constexpr double kQuarter = double(std::numeric_limits<size_t>::max() / 4);

const Values kPictureValues[] = {
    {kTakesParams, kStructure, {"params.size"}, {0, -1}},
    {kTakesField, kStructure, {"light_field.size"}, {0}},
    {kTakesOut, kStructure, {"report.size"}, {0}},
    {kAfter, kStructure, {"previous.size", "previous.light_field.size"}, {0}},

    {kTakesField, kNull, {"views[0].planes[0]", "views[16].planes[0]", "depth.data"}, {0}},
    {kTakesOut, kNull, {"out.planes[0]"}, {0}},
    {kAfter, kNull, {"previous.light_field", "previous.out", "previous.out.planes[0]"}, {0}},
    {kAfter, kNull, {"previous.light_field.views[4].planes[0]"}, {0}},

    {kTakesField, kStride, {"views[0].strides[0]", "views[16].strides[0]"}, {0, 59, -1}},
    {kTakesField, kStride, {"depth.stride"}, {0, 76, 82, -4}},
    {kTakesOut, kStride, {"out.strides[0]"}, {0, 1, -1, kQuarter}},
    {kTakesOut & ~kPreview, kStride, {"out.strides[0]"}, {59}},
    {kPreview, kStride, {"out.strides[0]"}, {29}},
    {kAfter, kStride, {"previous.out.strides[0]"}, {59}},
    {kAfter, kStride, {"previous.light_field.depth.stride"}, {4}},

    {kAfter, kFeature, {"out.format", "previous.out.format"}, {STARFOCUS_FORMAT_BGR}},
    {kAfter, kFeature, {"previous.light_field.views[2].format"}, {STARFOCUS_FORMAT_BGR}},
    {kAfter, kRange, {"previous.out.format"}, {99}},
    {kAfter, kRange, {"previous.out.pixel_stride"}, {2}},
    {kAfter,
     kRange,
     {"previous.light_field.depth.type", "previous.light_field.depth.meaning"},
     {9}},
    {kAfter,
     kRange,
     {"previous.light_field.depth.width", "previous.light_field.depth.height"},
     {0}},
    {kAfter, kRange, {"previous.light_field.depth.scale"}, {0}},
    {kAfter, kNull, {"previous.light_field.depth.data"}, {0}},
    {kInPlace | kBegin, kRange, {"preview_shift"}, {1}},
    {kPreview, kOther, {"preview_shift"}, {-1, 3, 32}},
    {kTakesParams, kFeature, {"shape"}, {STARFOCUS_SHAPE_POLYGON}},
    {kTakesParams, kFeature, {"cats_eye"}, {1e-9}},
};

const Values kImageValues[] = {
    {kViews, kNull, {"views[1].planes[0]", "views[1].planes[1]", "depth.data"}, {0}},
    {kViews, kOk, {"views[1].planes[2]"}, {0}},  // NV12 has two planes
    {kOuts, kNull, {"out.planes[2]"}, {0}},
    {kViews, kStride, {"views[1].strides[0]"}, {20}},
    {kViews, kStride, {"views[1].strides[1]"}, {21}},
    {kViews, kStride, {"depth.stride"}, {18, 21}},
    {kOuts, kStride, {"out.strides[2]"}, {10}},
    {kOuts, kStride, {"out.strides[0]"}, {kQuarter}},
    {kViews, kRange, {"views[0].pixel_stride"}, {2, -3, 257}},
    {kViews, kRange, {"views[1].pixel_stride"}, {1}},
    {kViews, kOk, {"views[1].pixel_stride"}, {2}},
    {kOuts, kRange, {"out.pixel_stride"}, {2}},
    {kViews, kRange, {"depth.scale"}, {0, kNan}},
    {kViews, kRange, {"depth.offset"}, {kNan}},
};

// Other changes that make a call illegal.
struct Change {
  unsigned functions;
  std::string path;
  starfocus_status status;
  void (*spoil)(Call*);
};

void PutOut(Call* c, const void* to) {
  c->out.planes[0] = static_cast<uint8_t*>(const_cast<void*>(to));
}
uint8_t* LastOf(test::Engine* engine) { return engine->workspace() + engine->bytes() - 1; }
void SetRegion(Call* c, size_t stride) {
  c->params.region = {3, 4, 5, 6};
  c->out.strides[0] = stride;
}

const Change kPictureChanges[] = {
    {kAll, "", kOk, [](Call*) {}},
    {kAll, "", kNull, [](Call* c) { c->engine = nullptr; }},
    {kTakesParams, "params", kNull, [](Call* c) { c->params_at = nullptr; }},
    {kTakesField, "light_field", kNull, [](Call* c) { c->field_at = nullptr; }},
    {kTakesOut, "out", kNull, [](Call* c) { c->out_at = nullptr; }},
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
    {kTakesParams, "aperture", STARFOCUS_ERROR_BLUR, [](Call* c) { c->params.focus = 6.5; }},
    {kTakesParams, "aperture", STARFOCUS_ERROR_BLUR, [](Call* c) { c->params.focus = -6.5; }},
    {kTakesParams, "aperture", STARFOCUS_ERROR_BLUR, [](Call* c) { c->params.focus = 1e6; }},
    // A call that gets a prepared light field for an engine, or the reverse, is refused.
    {kPrepared | kPreview, "prepared", kOther,
     [](Call* c) { c->prepared = reinterpret_cast<starfocus_prepared*>(c->engine); }},
    {kPrepared | kPreview | kBegin, "previous", kRange,
     [](Call* c) { c->params.previous = &c->before; }},
    {kTakesField, "depth.data", kStride,
     [](Call* c) { c->field.depth.data = static_cast<const char*>(c->field.depth.data) + 1; }},
    {kAfter, "previous.light_field.coverage_stride", kStride,
     [](Call* c) {
       c->field_before.coverage = c->f.scene.pictures[0].data();
       c->field_before.coverage_stride = 19;
     }},
    {kAfter, "previous.light_field.depth", kFeature,
     [](Call* c) { c->field_before.depth.scale = 2; }},

    {kPrepare, "memory", kOverlap, [](Call* c) { c->memory = c->f.engine.workspace(); }},
    {kPrepare, "memory", kOverlap, [](Call* c) { c->field.depth.data = c->memory; }},
    {kTakesOut, "out", kOverlap, [](Call* c) { PutOut(c, c->f.engine.workspace()); }},
    {kTakesOut, "out", kOverlap, [](Call* c) { PutOut(c, LastOf(&c->f.engine)); }},
    {kPrepared | kPreview, "out", kOverlap,
     [](Call* c) { PutOut(c, c->f.memory.get() + c->f.memory.bytes - 1); }},
    {kInPlace, "out", kOverlap, [](Call* c) { PutOut(c, c->f.scene.pictures[0].data()); }},
    {kInPlace, "out", kOverlap, [](Call* c) { PutOut(c, &c->f.scene.pictures[16].back()); }},
    {kInPlace, "out", kOverlap, [](Call* c) { PutOut(c, c->f.scene.disparity.data()); }},
    {kInPlace, "out", kOverlap, [](Call* c) { PutOut(c, &c->f.scene.disparity.back()); }},
    {kAfter, "out", kOverlap, [](Call* c) { PutOut(c, c->picture_before.Colour(1, 0, 0)); }},
    {kAfter, "out", kOverlap,
     [](Call* c) {
       c->field_before = c->f.image.converted.Field();
       PutOut(c, c->f.image.converted.pictures[2].data());
     }},

    // Arguments that only an engine without STARFOCUS_FEATURE_IMAGES rejects.
    {kTakesField, "views[0].format", kFeature,
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
    {kTakesParams & ~kBegin, "region.width", kRange, [](Call* c) { c->params.region.x = 1; }},
    {kRefocus | kPrepared, "out.strides", kStride, [](Call* c) { SetRegion(c, 14); }},
    {kRefocus | kPrepared, "", kOk, [](Call* c) { SetRegion(c, 15); }},
    {kRefocus | kPrepared, "out", kOverlap,
     [](Call* c) {
       SetRegion(c, 15);
       PutOut(c, c->f.engine.workspace() - 1);
     }},
};

const Change kImageChanges[] = {
    {kAll & ~kAfter, "", kOk, [](Call*) {}},
    {kViews, "views[0].strides", kStride, [](Call* c) { c->field.views[0].pixel_stride = 4; }},
    {kViews, "views[0].pixel_stride", kRange,
     [](Call* c) {
       c->field.views[0].format = STARFOCUS_FORMAT_RGBX;
       c->field.views[0].pixel_stride = 3;
     }},
    {kViews, "views[0].strides", kStride,
     [](Call* c) {
       c->field.views[0].format = STARFOCUS_FORMAT_RGBX;
       c->field.views[0].strides[0] = 4 * 21 - 1;
     }},
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

template <class Ranges>
void CheckRanges(Fixture* f, const Ranges& ranges) {
  for (const Range& row : ranges) {
    for (const double value : Outside(Call(f, kRefocus).At(row.path).type, row.low, row.high)) {
      CAPTURE(value);
      const auto spoil = [&](Call* c) {
        if (row.path.find("region") == 0) c->params.region = {3, 4, 1, 1};
        c->At(row.path).Set(value);
      };
      Check(f, row.functions, spoil, kRange, row.path);
      CheckRange(starfocus_engine_problem(f->engine.get()), NameOf(row.path), value, row.low,
                 row.high);
    }
  }
}

template <class Rows>
void CheckValues(Fixture* f, const Rows& rows) {
  for (const Values& row : rows) {
    for (const std::string& path : row.paths) {
      for (const double value : row.values) {
        CAPTURE(value);
        const auto spoil = [&](Call* c) { c->At(path).Set(value); };
        Check(f, row.functions, spoil, row.status, path);
      }
    }
  }
}

TEST_CASE("calls: illegal pictures, light fields, lenses and memory are rejected and named") {
  Fixture pictures(false);
  CheckRanges(&pictures, kLensRanges);
  CheckValues(&pictures, kPictureValues);
  for (const Change& row : kPictureChanges) {
    Check(&pictures, row.functions, row.spoil, row.status, row.path);
  }
  const auto whole = [](Call* c) { c->params.region = {0, 0, 20, kHeight}; };
  Check(&pictures, kBegin, whole, kRange, "region");
}

TEST_CASE("calls: illegal images and depth maps are rejected and named") {
  Fixture images(true);
  CheckRanges(&images, kImageRanges);
  CheckValues(&images, kImageValues);
  for (const Change& row : kImageChanges) {
    Check(&images, row.functions, row.spoil, row.status, row.path);
  }
}

TEST_CASE("calls: illegal disparity values are rejected at any position") {
  Fixture f(false);
  const float inf = float(kInf);
  for (const float bad : {float(kNan), inf, -inf, 2.0001f, -2.0001f, 3e38f, -3e38f}) {
    const bool finite = std::abs(bad) < inf;
    for (const int y : {0, kHeight / 2, kHeight - 1}) {
      for (const int x : {0, 7, 19}) {
        const float good = f.scene.Disparity(x, y);
        f.scene.Disparity(x, y) = bad;
        Check(
            &f, kInPlace | kPrepare, [](Call*) {},
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

TEST_CASE("calls: the limits of the ranges of a lens are legal, and the report has the blur") {
  const test::Scene scene = test::RandomScene(20, kHeight, 17, -2, 2, 1);
  test::Config config = test::ConfigFor(scene, 8);
  config.features |= STARFOCUS_FEATURE_SHAPES | STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  for (const Range& row : kLensRanges) {
    if (row.path.find("region") == 0) continue;
    for (const double limit : {row.low, row.high}) {
      CAPTURES(row.path, limit);
      starfocus::Params params = test::Params(0.5, 0);
      FieldAt("starfocus_params", static_cast<starfocus_params*>(&params), row.path).Set(limit);
      CHECK(starfocus_stream_begin(engine.get(), &params) == kOk);
    }
  }
  starfocus::Params params = test::Params(6);  // the blur radius is 8, the configured maximum
  params.curvature = 1;
  params.ring_inner = STARFOCUS_MAX_RING_INNER;
  params.blades = STARFOCUS_MAX_BLADES;
  params.rotation = 360;
  test::Report report;
  test::OutputOf(&engine, params, scene, &report);
  CHECK(report.r_max == 8);
}

TEST_CASE("calls: problems report the limits of preview_shift and rows, and what is expected") {
  Fixture f(false);
  const auto problem_of = [&](unsigned function, void (*spoil)(Call*)) {
    Call call(&f, function);
    spoil(&call);
    CHECK(call.Run() != kOk);
    return *starfocus_engine_problem(f.engine.get());
  };
  const auto shift = problem_of(kPreview, [](Call* c) { c->params.preview_shift = 3; });
  CHECK(shift.low == 0);
  CHECK(shift.high == 2);
  const auto pulled = problem_of(kPull, [](Call* c) { c->rows = -1; });
  CHECK(pulled.expected == std::string("at least 0"));
  CHECK(pulled.high >= STARFOCUS_MAX_SIZE);
  const auto pushed = problem_of(kPush, [](Call* c) { c->rows = kHeight + 1; });
  CHECK(pushed.high == kHeight);
  const auto memory = problem_of(kPrepare, [](Call* c) { c->memory += 8; });
  CHECK(std::isnan(memory.value));
  const auto prepared = problem_of(
      kPrepared, [](Call* c) { c->prepared = reinterpret_cast<starfocus_prepared*>(c->engine); });
  CHECK(prepared.expected == std::string("prepared with the engine's size, views, positions, "
                                         "disparity range, max_layer and transfer"));
}

TEST_CASE("stream: calls with wrong arguments do not end a stream, and accepted calls do") {
  Fixture f(false);
  const auto check = [&](unsigned function, auto&& spoil, starfocus_status status, bool ends) {
    CAPTURE(function);
    Call other(&f, function), pull(&f, kPull);
    spoil(&other);
    CHECK(other.Run() == status);
    CHECK(pull.Run() == (ends ? STARFOCUS_ERROR_STATE : kOk));
    CHECK(pull.count == (ends ? 0 : kHeight));
  };
  const auto legal = [](Call*) {};
  const auto null = [](Call* c) { c->out_at = nullptr, c->field_at = nullptr; };
  const auto blurred = [](Call* c) { c->params.focus = 6.5; };
  for (const unsigned function : {kRefocus, kPrepared, kPreview, kPrepare}) {
    check(function, legal, kOk, true);
    check(function, null, kNull, false);
    if (function != kPrepare) check(function, blurred, STARFOCUS_ERROR_BLUR, false);
  }
  float& disparity = f.scene.Disparity(7, 3);
  const float good = disparity;
  for (const unsigned function : {kRefocus, kPrepare}) {
    check(
        function, [&](Call*) { disparity = 100; }, STARFOCUS_ERROR_DISPARITY, true);
    disparity = good;
  }
}

TEST_CASE("stream: without the feature or an accepted begin, pushes and pulls fail") {
  Fixture f(false);
  for (const bool streaming : {true, false}) {
    CAPTURE(streaming);
    test::Engine engine(f.MakeConfig(streaming ? STARFOCUS_FEATURE_STREAMING : 0));
    Call begin(&f, kBegin), push(&f, kPush), pull(&f, kPull);
    begin.engine = push.engine = pull.engine = engine.get();
    CHECK(push.Run() == STARFOCUS_ERROR_STATE);
    if (streaming) begin.params.aperture = 2;
    CHECK(begin.Run() == (streaming ? kRange : kFeature));
    CHECK(push.Run() == STARFOCUS_ERROR_STATE);
    CHECK(pull.Run() == STARFOCUS_ERROR_STATE);
    CHECK(pull.Untouched());
  }
}

TEST_CASE("stream: a rejected push consumes nothing, and begin restarts a stopped stream") {
  Fixture f(false);
  Call push(&f, kPush);
  const auto pushed = [&](int32_t rows, starfocus_status status) {
    push.rows = rows;
    CHECK(push.Run() == status);
    return push.count;
  };
  pushed(kHeight + 1, kRange);
  CHECK(pushed(0, kOk) == 0);
  CHECK(pushed(5, kOk) == 5);
  pushed(kHeight - 4, kRange);
  const test::Output whole = test::OutputOf(&f.plain, push.params, f.scene);
  test::Output streamed(f.width, kHeight);
  REQUIRE(test::Stream(&f.engine, push.params, f.scene, &streamed, 7, 9) == kOk);
  CHECK(streamed.bytes == whole.bytes);
  pushed(1, kRange);  // all rows have been pushed
}

TEST_CASE("stream: a row with a bad disparity is rejected, and the preceding rows are accepted") {
  Fixture f(false);
  test::Output expected(f.width, kHeight);
  const starfocus::Params params = test::Params(0.5);
  REQUIRE(test::Stream(&f.engine, params, f.scene, &expected, 8, 8) == kOk);
  for (const float bad : {float(kNan), float(kInf), 2.5f}) {
    for (const int row : {0, 1, 3}) {
      CAPTURES(bad, row);
      float& disparity = f.scene.Disparity(f.width - 1, row);
      const float good = std::exchange(disparity, bad);
      REQUIRE(starfocus_stream_begin(f.engine.get(), &params) == kOk);
      int32_t consumed = -1;
      CHECK(starfocus_stream_push(f.engine.get(), &f.field, 5, &consumed) ==
            (bad == 2.5f ? STARFOCUS_ERROR_DISPARITY : STARFOCUS_ERROR_NOT_FINITE));
      CHECK(consumed == row);
      CHECK(starfocus_engine_problem(f.engine.get())->x == f.width - 1);
      CHECK(starfocus_engine_problem(f.engine.get())->y == row);
      // After a rejected row, the caller may correct the disparities of this row and continue.
      disparity = good;
      test::Output out(f.width, kHeight);
      test::StreamSteps steps = {&f.engine, f.scene, &out, consumed};
      while (!steps.Ended()) REQUIRE(steps.Step() == kOk);
      CHECK(out.bytes == expected.bytes);
    }
  }
}

}  // namespace
}  // namespace refusals_bytes_test
