// SPDX-License-Identifier: Apache-2.0
// Tests tables of arguments that starfocus_estimate_disparity and starfocus_repair_disparity must
// reject. Each row changes one argument of a valid call. The call must return the status of the row
// and write nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "starfocus/depth.h"
#include "tests/depth/depth_scene.h"
#include "tests/support/config.h"

namespace map_refusals_bytes_test {
namespace {

enum : int { kEstimate = 1, kRepair = 2, kBoth = 3 };

constexpr starfocus_status kNull = STARFOCUS_ERROR_NULL, kStride = STARFOCUS_ERROR_STRIDE,
                           kWorkspace = STARFOCUS_ERROR_WORKSPACE,
                           kOverlap = STARFOCUS_ERROR_OVERLAP, kRange = STARFOCUS_ERROR_RANGE,
                           kStructure = STARFOCUS_ERROR_STRUCTURE;

// The arguments of a call: an estimate from 17 views, or a repair of one view with coverage.
struct Call {
  explicit Call(int to) : function(to) {
    field.depth = starfocus_depth_float(given.data(), row, planes.width, planes.height);
    if (function == kEstimate) out.coverage = nullptr;
  }
  // Renders the views once, because this takes long on emulators.
  test::PlaneField Planes() const {
    static const test::PlaneField estimated = Rendered(17), repaired = Rendered(1);
    return function == kEstimate ? estimated : repaired;
  }
  static test::PlaneField Rendered(int views) {
    test::PlaneScene scene;
    scene.views = views;
    return test::RenderPlanes(scene);
  }
  size_t Bytes() const {
    size_t needed = 0;
    REQUIRE(SizeOf(&config, &needed) == STARFOCUS_OK);
    return needed;
  }
  starfocus_status SizeOf(const starfocus_config* of, size_t* needed) const {
    return starfocus_map_workspace_size(of, function == kEstimate ? 0 : 1, needed, nullptr);
  }
  starfocus_status Run() {
    return (function == kEstimate ? starfocus_estimate_disparity : starfocus_repair_disparity)(
        &config, &callbacks, &field, out_at, at, bytes, nullptr);
  }
  // Returns true if the call wrote no output.
  bool Untouched() const {
    const auto poisoned = [](const auto& plane) {
      return std::all_of(plane.begin(), plane.end(), [](auto value) { return value == 42; });
    };
    return poisoned(map) && poisoned(sure) && poisoned(coverage) && out.has_coverage == -1;
  }

  const int function;
  test::PlaneField planes = Planes();
  test::Config config = test::ConfigOf(planes, -6, 8);
  starfocus_callbacks callbacks = {};
  const size_t width = size_t(planes.width), row = sizeof(float) * width;
  const size_t pixels = width * size_t(planes.height);
  std::vector<float> given = std::vector<float>(pixels, 1), map = std::vector<float>(pixels, 42);
  std::vector<uint8_t> sure = std::vector<uint8_t>(pixels, 42), coverage = sure;
  starfocus_light_field field = planes.Get();
  starfocus_disparity_output out = {map.data(),      row,   sure.data(), width,
                                    coverage.data(), width, -1};
  starfocus_disparity_output* out_at = &out;
  size_t bytes = Bytes();
  test::Memory memory{bytes + STARFOCUS_ALIGNMENT};
  char* at = static_cast<char*>(memory.data);
};

struct Refusal {
  int functions;
  starfocus_status status;
  void (*spoil)(Call* call);
};

uint8_t* BytesOf(void* data) { return static_cast<uint8_t*>(data); }

const Refusal kArguments[] = {
    {kBoth, kNull, [](Call* c) { c->out_at = nullptr; }},
    {kBoth, kNull, [](Call* c) { c->out.disparity = nullptr; }},
    {kBoth, kNull, [](Call* c) { c->at = nullptr; }},
    {kBoth, kNull, [](Call* c) { c->field.views[0].planes[0] = nullptr; }},
    {kEstimate, kNull, [](Call* c) { c->field.views[16].planes[0] = nullptr; }},
    {kRepair, kNull, [](Call* c) { c->field.depth.data = nullptr; }},
    {kBoth, kStride, [](Call* c) { c->out.disparity_stride -= 4; }},
    {kBoth, kStride, [](Call* c) { c->out.disparity_stride += 2; }},
    {kBoth, kStride, [](Call* c) { --c->out.confidence_stride; }},
    {kRepair, kStride, [](Call* c) { --c->out.coverage_stride; }},
    {kBoth, kStride, [](Call* c) { --c->field.views[0].strides[0]; }},
    {kEstimate, kStride, [](Call* c) { --c->field.views[3].strides[0]; }},
    {kRepair, kStride, [](Call* c) { c->field.depth.stride -= 4; }},
    {kBoth, kWorkspace, [](Call* c) { --c->bytes; }},
    {kBoth, kWorkspace, [](Call* c) { c->at += 4; }},
    {kBoth, kOverlap, [](Call* c) { c->out.disparity = static_cast<float*>(c->memory.data); }},
    {kBoth, kOverlap, [](Call* c) { c->out.confidence = BytesOf(&c->map[1]); }},
    {kEstimate, kOverlap, [](Call* c) { c->out.confidence = c->planes.views[16].data(); }},
    {kRepair, kOverlap, [](Call* c) { c->field.depth.data = c->map.data(); }},
    {kRepair, kOverlap, [](Call* c) { c->field.depth.data = c->memory.data; }},
    {kRepair, kOverlap, [](Call* c) { c->out.coverage = c->sure.data(); }},
    {kRepair, kOverlap, [](Call* c) { c->out.coverage = BytesOf(c->map.data()); }},
    {kRepair, kOverlap, [](Call* c) { c->out.coverage = c->planes.views[0].data(); }},
    {kRepair, kOverlap, [](Call* c) { c->out.coverage = BytesOf(c->memory.data); }},
    {kRepair, STARFOCUS_ERROR_DISPARITY, [](Call* c) { c->given[100] = 8.01F; }},
    {kRepair, STARFOCUS_ERROR_ALL_INVALID,
     [](Call* c) { std::fill(c->given.begin(), c->given.end(), NAN); }},
};

// Configures a pair of views.
void Place(double u, double v, Call* call) {
  call->config.views = 2;
  call->config.positions[1] = {u, v};
}

const Refusal kConfigurations[] = {
    {kBoth, kStructure, [](Call* c) { c->config.size = 0; }},
    {kBoth, kStructure, [](Call* c) { ++c->config.size; }},
    {kBoth, kRange, [](Call* c) { c->config.width = 0; }},
    {kBoth, kRange, [](Call* c) { c->config.height = 65536; }},
    {kEstimate, kRange, [](Call* c) { c->config.views = 1; }},
    {kBoth, kRange, [](Call* c) { c->config.views = 18; }},
    {kBoth, kRange, [](Call* c) { c->config.views = 4; }},
    {kEstimate, kRange, [](Call* c) { c->config.positions[1].u = 1; }},
    {kEstimate, kRange, [](Call* c) { Place(1.01, 0, c); }},
    {kEstimate, kRange, [](Call* c) { Place(0, NAN, c); }},
    {kRepair, kRange, [](Call* c) { Place(1, 0, c); }},
    {kBoth, kRange, [](Call* c) { c->config.disparity_min = 9; }},
    {kEstimate, kRange,
     [](Call* c) {
       const test::Config fresh;
       c->config.disparity_min = fresh.disparity_min;
       c->config.disparity_max = fresh.disparity_max;
     }},
    {kBoth, kRange, [](Call* c) { c->config.disparity_min = NAN; }},
    {kBoth, kRange, [](Call* c) { c->config.disparity_max = NAN; }},
    {kBoth, kRange, [](Call* c) { c->config.disparity_max = 501; }},
    {kBoth, kRange, [](Call* c) { c->config.max_workers = 0; }},
    {kBoth, kRange, [](Call* c) { c->config.max_workers = 65; }},
};

// Runs each row of a table for each function that the row names.
template <size_t kCount, class Run>
void CheckTable(const Refusal (&table)[kCount], const Run& run) {
  for (const int function : {kEstimate, kRepair}) {
    for (const Refusal& row : table) {
      if ((row.functions & function) == 0) continue;
      CAPTURES(function, &row - table);
      Call call(function);
      row.spoil(&call);
      CHECK(run(&call) == row.status);
      CHECK(call.Untouched());
    }
  }
}

TEST_CASE("maps: calls with bad arguments return the expected status and write nothing") {
  CheckTable(kArguments, [](Call* call) { return call->Run(); });
}

TEST_CASE("maps: fields beyond the end of a shorter configuration get their defaults") {
  for (const int function : {kEstimate, kRepair}) {
    Call call(function);
    // A size is a multiple of the alignment.
    call.config.size = offsetof(starfocus_config, max_workers) / alignof(starfocus_config) *
                       alignof(starfocus_config);
    call.config.max_workers = -1;
    CHECK(call.Run() == STARFOCUS_OK);
  }
}

TEST_CASE("maps: calls with bad configurations return the expected status") {
  const auto size_of = [](Call* call) {
    size_t needed = 0;
    return call->SizeOf(&call->config, &needed);
  };
  CheckTable(kConfigurations, size_of);
  size_t needed = 0;
  for (const int function : {kEstimate, kRepair}) {
    Call call(function);
    CHECK(call.SizeOf(nullptr, &needed) == kNull);
    CHECK(call.SizeOf(&call.config, nullptr) == kNull);
    call.callbacks.runner = [](void*, starfocus_job, void*, int32_t) { return 0; };
    CHECK(call.Run() == STARFOCUS_ERROR_RUNNER);
  }
}

}  // namespace
}  // namespace map_refusals_bytes_test
