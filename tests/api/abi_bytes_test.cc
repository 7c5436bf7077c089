// SPDX-License-Identifier: Apache-2.0
// Bad input of every public function but the streaming ones: each illegal value is told by its
// field, and nothing is written. Illegal values first, as callers meet them.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "starfocus/starfocus.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace abi_bytes_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfF = std::numeric_limits<float>::infinity();
constexpr size_t kHuge = std::numeric_limits<size_t>::max();

// What spoils a structure, with the status and the field that are told.
template <class Structure>
struct Bad {
  const char* field;
  void (*spoil)(Structure*);
  sf_status status = SF_ERROR_RANGE;
};

const Bad<sf_config> kBadConfigs[] = {
    {"", [](sf_config* c) { c->size = 0; }, SF_ERROR_STRUCTURE},
    {"", [](sf_config* c) { c->size = 4; }, SF_ERROR_STRUCTURE},
    {"", [](sf_config* c) { c->size = sizeof(sf_config) + 1; }, SF_ERROR_STRUCTURE},
    {"", [](sf_config* c) { c->size = UINT32_MAX; }, SF_ERROR_STRUCTURE},
    {"features", [](sf_config* c) { c->features |= 64; }},
    {"features", [](sf_config* c) { c->features = 0x80000000u; }},
    {"width", [](sf_config* c) { c->width = 0; }},
    {"width", [](sf_config* c) { c->width = -1; }},
    {"width", [](sf_config* c) { c->width = SF_MAX_SIZE + 1; }},
    {"width", [](sf_config* c) { c->width = INT32_MAX; }},
    {"width", [](sf_config* c) { c->width = INT32_MIN; }},
    {"height", [](sf_config* c) { c->height = 0; }},
    {"height", [](sf_config* c) { c->height = -1; }},
    {"height", [](sf_config* c) { c->height = SF_MAX_SIZE + 1; }},
    {"height", [](sf_config* c) { c->height = INT32_MAX; }},
    {"views", [](sf_config* c) { c->views = 0; }},
    {"views", [](sf_config* c) { c->views = -1; }},
    {"views", [](sf_config* c) { c->views = 2; }},
    {"views", [](sf_config* c) { c->views = 16; }},
    {"views", [](sf_config* c) { c->views = 18; }},
    {"disparity_min", [](sf_config* c) { c->disparity_min = kNanF; }},
    {"disparity_max", [](sf_config* c) { c->disparity_max = kNanF; }},
    {"disparity_min", [](sf_config* c) { c->disparity_min = -kInfF; }},
    {"disparity_max", [](sf_config* c) { c->disparity_max = kInfF; }},
    {"disparity_max", [](sf_config* c) { c->disparity_min = 5; }},
    {"disparity_max", [](sf_config* c) { c->disparity_max = 501; }},
    {"disparity_min", [](sf_config* c) { c->disparity_min = -501; }},
    {"max_blur", [](sf_config* c) { c->max_blur = 0; }},
    {"max_blur", [](sf_config* c) { c->max_blur = -1; }},
    {"max_blur", [](sf_config* c) { c->max_blur = 128.5; }},
    {"max_blur", [](sf_config* c) { c->max_blur = kNan; }},
    {"max_blur", [](sf_config* c) { c->max_blur = kInf; }},
    {"superblock", [](sf_config* c) { c->superblock = 1; }},
    {"superblock", [](sf_config* c) { c->superblock = -64; }},
    {"superblock", [](sf_config* c) { c->superblock = 16; }},
    {"superblock", [](sf_config* c) { c->superblock = 48; }},
    {"superblock", [](sf_config* c) { c->superblock = 512; }},
    {"max_workers", [](sf_config* c) { c->max_workers = 0; }},
    {"max_workers", [](sf_config* c) { c->max_workers = -1; }},
    {"max_workers", [](sf_config* c) { c->max_workers = SF_MAX_WORKERS + 1; }},
    {"tuning.max_layer", [](sf_config* c) { c->tuning.max_layer = -1; }},
    {"tuning.max_layer", [](sf_config* c) { c->tuning.max_layer = SF_LAYERS; }},
    {"tuning.max_layer", [](sf_config* c) { c->tuning.max_layer = INT32_MIN; }},
    {"tuning.max_layer", [](sf_config* c) { c->tuning.max_layer = INT32_MAX; }},
    {"tuning.deblocking", [](sf_config* c) { c->tuning.deblocking = -1; }},
    {"tuning.deblocking", [](sf_config* c) { c->tuning.deblocking = 256; }},
    {"tuning.deblocking", [](sf_config* c) { c->tuning.deblocking = INT32_MIN; }},
    {"tuning.deblocking", [](sf_config* c) { c->tuning.deblocking = INT32_MAX; }},
    {"tuning.timing.block", [](sf_config* c) { c->tuning.timing.block = SF_MAX_TIMING + 1; }},
    {"tuning.timing.field", [](sf_config* c) { c->tuning.timing.field = SF_MAX_TIMING + 1; }},
    {"tuning.timing.a", [](sf_config* c) { c->tuning.timing.a = SF_MAX_TIMING + 1; }},
    {"tuning.timing.b", [](sf_config* c) { c->tuning.timing.b = UINT32_MAX; }},
    {"tuning.timing.c", [](sf_config* c) { c->tuning.timing.c = 0x80000000u; }},
    {"tuning.timing.span", [](sf_config* c) { c->tuning.timing.span = SF_MAX_TIMING + 1; }},
    {"tuning.timing.hole", [](sf_config* c) { c->tuning.timing.hole = UINT32_MAX; }},
    {"tuning.timing.upsample", [](sf_config* c) { c->tuning.timing.upsample = UINT32_MAX; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = 0; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = 0.4999; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = 2.0001; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = -1; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = kNan; }},
    {"tuning.n_scale", [](sf_config* c) { c->tuning.n_scale = kInf; }},
    {"tuning.skips", [](sf_config* c) { c->tuning.skips = -1; }},
    {"tuning.skips", [](sf_config* c) { c->tuning.skips = 2; }},
    {"tuning.gather", [](sf_config* c) { c->tuning.gather = -1; }},
    {"tuning.gather", [](sf_config* c) { c->tuning.gather = 2; }},
    {"highlights", [](sf_config* c) { c->highlights = 0.99F; }},
    {"highlights", [](sf_config* c) { c->highlights = 64.1F; }},
    {"highlights", [](sf_config* c) { c->highlights = float(kNan); }},
    {"transfer", [](sf_config* c) { c->transfer = -1; }},
    {"transfer", [](sf_config* c) { c->transfer = 2; }},
};

// For an engine of disparities [-2, 2] and max_blur 8.
const Bad<sf_params> kBadParams[] = {
    {"params.size", [](sf_params* p) { p->size = 0; }, SF_ERROR_STRUCTURE},
    {"params.size", [](sf_params* p) { p->size = 4; }, SF_ERROR_STRUCTURE},
    {"params.size", [](sf_params* p) { p->size = sizeof(sf_params) + 1; }, SF_ERROR_STRUCTURE},
    {"params.size", [](sf_params* p) { p->size = UINT32_MAX; }, SF_ERROR_STRUCTURE},
    {"mode", [](sf_params* p) { p->mode = -1; }},
    {"mode", [](sf_params* p) { p->mode = SF_MODE_BLUR + 1; }},
    {"mode", [](sf_params* p) { p->mode = 1000; }},
    {"renderer", [](sf_params* p) { p->renderer = -1; }},
    {"renderer", [](sf_params* p) { p->renderer = SF_RENDERER_SLICES + 1; }},
    {"lens.focus", [](sf_params* p) { p->lens.focus = kNan; }},
    {"lens.focus", [](sf_params* p) { p->lens.focus = kInf; }},
    {"lens.focus", [](sf_params* p) { p->lens.focus = -kInf; }},
    {"lens.focus", [](sf_params* p) { p->lens.focus = 1.1e6; }},
    {"lens.focus", [](sf_params* p) { p->lens.focus = -1e300; }},
    {"lens.aperture", [](sf_params* p) { p->lens.aperture = -1e-300; }},
    {"lens.aperture", [](sf_params* p) { p->lens.aperture = -0.5; }},
    {"lens.aperture", [](sf_params* p) { p->lens.aperture = 1.0000001; }},
    {"lens.aperture", [](sf_params* p) { p->lens.aperture = kNan; }},
    {"lens.aperture", [](sf_params* p) { p->lens.aperture = kInf; }},
    {"lens.shape", [](sf_params* p) { p->lens.shape = -1; }},
    {"lens.shape", [](sf_params* p) { p->lens.shape = SF_SHAPE_RING + 1; }},
    {"lens.shape", [](sf_params* p) { p->lens.shape = INT32_MAX; }},
    {"lens.shape", [](sf_params* p) { p->lens.shape = INT32_MIN; }},
    {"lens.blades", [](sf_params* p) { p->lens.blades = 0; }},
    {"lens.blades", [](sf_params* p) { p->lens.blades = SF_MIN_BLADES - 1; }},
    {"lens.blades", [](sf_params* p) { p->lens.blades = SF_MAX_BLADES + 1; }},
    {"lens.blades", [](sf_params* p) { p->lens.blades = -5; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = 0; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = 0.157; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = 1.414; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = -0.8; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = kNan; }},
    {"lens.theta", [](sf_params* p) { p->lens.theta = kInf; }},
    {"lens.rotation", [](sf_params* p) { p->lens.rotation = -360.1; }},
    {"lens.rotation", [](sf_params* p) { p->lens.rotation = 360.1; }},
    {"lens.rotation", [](sf_params* p) { p->lens.rotation = kNan; }},
    {"lens.rotation", [](sf_params* p) { p->lens.rotation = -kInf; }},
    {"lens.curvature", [](sf_params* p) { p->lens.curvature = -0.001; }},
    {"lens.curvature", [](sf_params* p) { p->lens.curvature = 1.001; }},
    {"lens.curvature", [](sf_params* p) { p->lens.curvature = kNan; }},
    {"lens.ring_inner", [](sf_params* p) { p->lens.ring_inner = -0.001; }},
    {"lens.ring_inner", [](sf_params* p) { p->lens.ring_inner = 0.901; }},
    {"lens.ring_inner", [](sf_params* p) { p->lens.ring_inner = kNan; }},
    {"lens.cats_eye", [](sf_params* p) { p->lens.cats_eye = -0.001; }},
    {"lens.cats_eye", [](sf_params* p) { p->lens.cats_eye = 1.001; }},
    {"lens.cats_eye", [](sf_params* p) { p->lens.cats_eye = kNan; }},
    {"lens.shape", [](sf_params* p) { p->lens.shape = SF_SHAPE_POLYGON; }, SF_ERROR_FEATURE},
    {"lens.cats_eye", [](sf_params* p) { p->lens.cats_eye = 1e-9; }, SF_ERROR_FEATURE},
    {"preview_shift", [](sf_params* p) { p->preview_shift = 1; }},
    {"lens.aperture", [](sf_params* p) { p->lens.focus = 6.5; }, SF_ERROR_BLUR},
    {"lens.aperture", [](sf_params* p) { p->lens.focus = -6.5; }, SF_ERROR_BLUR},
    {"lens.aperture", [](sf_params* p) { p->lens.focus = 1e6; }, SF_ERROR_BLUR},
};

// For a width of 20.
const Bad<sf_light_field> kBadFields[] = {
    {"views[].planes", [](sf_light_field* f) { f->views[0].planes[0] = nullptr; }, SF_ERROR_NULL},
    {"views[].planes", [](sf_light_field* f) { f->views[16].planes[0] = nullptr; }, SF_ERROR_NULL},
    {"depth.data", [](sf_light_field* f) { f->depth.data = nullptr; }, SF_ERROR_NULL},
    {"views[].strides", [](sf_light_field* f) { f->views[0].strides[0] = 0; }, SF_ERROR_STRIDE},
    {"views[].strides", [](sf_light_field* f) { f->views[16].strides[0] = 59; }, SF_ERROR_STRIDE},
    {"views[].strides", [](sf_light_field* f) { f->views[3].strides[0] = kHuge; }, SF_ERROR_STRIDE},
    {"depth.stride", [](sf_light_field* f) { f->depth.stride = 0; }, SF_ERROR_STRIDE},
    {"depth.stride", [](sf_light_field* f) { f->depth.stride = 76; }, SF_ERROR_STRIDE},
    {"depth.stride", [](sf_light_field* f) { f->depth.stride = 82; }, SF_ERROR_STRIDE},
    {"depth.stride", [](sf_light_field* f) { f->depth.stride = kHuge - 3; }, SF_ERROR_STRIDE},
};

constexpr int kWidth = 20, kHeight = 12;

template <class Structure>
void CheckProblem(const Bad<Structure>& bad, const sf_problem* problem) {
  REQUIRE(problem != nullptr);
  if (bad.field[0] == 0) return;
  CHECK(problem->status == bad.status);
  CHECK(std::string(problem->field) == bad.field);
  CHECK(problem->expected[0] != 0);
  if (bad.status == SF_ERROR_RANGE) {
    CHECK(!(problem->value >= problem->low && problem->value <= problem->high));
  }
}

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 17, -2, 2, 1);
  sf_config config = test::ConfigFor(scene, 8);
  sf_params params = test::Params(0.5);
  sf_light_field field = scene.Field();
  test::Output out{kWidth, kHeight, 4};
  sf_report report;
  sf_report report_before;

  Fixture() {
    std::memset(&report, test::kPoison, sizeof report);
    std::memcpy(&report_before, &report, sizeof report);
  }
  bool NothingWritten() const {
    return out.Untouched() && std::memcmp(&report, &report_before, sizeof report) == 0;
  }
  sf_status Refocus(sf_engine* engine) {
    return test::RefocusRgb(engine, &params, &field, out.bytes.data(), out.stride, &report);
  }
};

TEST_CASE("configuration: illegal values") {
  Fixture f;
  test::Engine legal(f.config);
  REQUIRE(legal.status() == SF_OK);
  for (const Bad<sf_config>& bad : kBadConfigs) {
    CAPTURE(bad.field);
    sf_problem problem = {};
    sf_config config = f.config;
    config.problem = &problem;
    bad.spoil(&config);
    size_t bytes = 4711;
    CHECK(sf_workspace_size(&config, &bytes) == bad.status);
    CheckProblem(bad, &problem);
    CHECK(bytes == 4711);
    sf_engine* engine = legal.get();
    std::vector<uint8_t> before(legal.workspace(), legal.workspace() + legal.bytes());
    CHECK(sf_init(&config, legal.workspace(), legal.bytes(), &engine) == bad.status);
    CheckProblem(bad, &problem);
    CHECK(engine == nullptr);
    CHECK(std::memcmp(before.data(), legal.workspace(), before.size()) == 0);
  }
}

TEST_CASE("configuration: null pointers and never initialised structures") {
  Fixture f;
  size_t bytes = 0;
  sf_engine* engine = nullptr;
  sf_config zero;
  std::memset(&zero, 0, sizeof zero);
  CHECK(sf_workspace_size(nullptr, &bytes) == SF_ERROR_NULL);
  CHECK(sf_workspace_size(&f.config, nullptr) == SF_ERROR_NULL);
  CHECK(sf_workspace_size(&zero, &bytes) == SF_ERROR_STRUCTURE);
  REQUIRE(sf_workspace_size(&f.config, &bytes) == SF_OK);
  std::vector<uint8_t> memory(bytes + SF_ALIGNMENT);
  CHECK(sf_init(nullptr, memory.data(), bytes, &engine) == SF_ERROR_NULL);
  CHECK(sf_init(&f.config, nullptr, bytes, &engine) == SF_ERROR_NULL);
  CHECK(sf_init(&f.config, memory.data(), bytes, nullptr) == SF_ERROR_NULL);
  sf_config_init(nullptr);
  sf_params_init(nullptr);
}

TEST_CASE("configuration: limits are legal") {
  sf_config config;
  sf_config_init(&config);
  config.width = config.height = SF_MAX_SIZE;
  config.views = SF_MAX_VIEWS;
  config.disparity_min = static_cast<float>(-SF_MAX_DISPARITY);
  config.disparity_max = static_cast<float>(SF_MAX_DISPARITY);
  config.max_blur = SF_MAX_BLUR;
  config.superblock = 256;
  config.max_workers = SF_MAX_WORKERS;
  config.features |= SF_FEATURE_STREAMING | SF_FEATURE_SHAPES;
  config.highlights = static_cast<float>(SF_MAX_HIGHLIGHTS);
  size_t bytes = 0;
  // Every value is legal, but all limits together are more than 32 bits address.
  const sf_status legal = sizeof(size_t) == 4 ? SF_ERROR_TOO_LARGE : SF_OK;
  CHECK(sf_workspace_size(&config, &bytes) == legal);
  CHECK((bytes > 0) == (legal == SF_OK));
  for (const double n_scale : {SF_MIN_N_SCALE, SF_MAX_N_SCALE}) {
    config.tuning.n_scale = n_scale;
    CHECK(sf_workspace_size(&config, &bytes) == legal);
  }
  for (const int max_layer : {0, 1, 2}) {
    for (const int deblocking : {0, 1, 255}) {
      for (const uint32_t timing : {0u, 1u, SF_MAX_TIMING}) {
        config.tuning.max_layer = max_layer;
        config.tuning.deblocking = deblocking;
        config.tuning.timing = {timing, timing, timing, timing, timing, timing, timing, timing};
        CHECK(sf_workspace_size(&config, &bytes) == legal);
      }
    }
  }
}

TEST_CASE("configuration: a superblock of 0 is 128 from a width of 1536 on, else 64") {
  for (const int width : {1, 1535, 1536, 1700}) {
    CAPTURE(width);
    const test::Scene scene = test::RandomScene(width, 3, 1, -2, 2, 9);
    sf_config config = test::ConfigFor(scene, 4);
    test::Engine chosen(config);
    config.superblock = width < 1536 ? 64 : 128;
    test::Engine told(config);
    CHECK(chosen.bytes() == told.bytes());
    test::Output a(width, 3), b(width, 3);
    sf_report report = {};
    const sf_params params = test::Params(1, 1, SF_MODE_BLOCK);
    REQUIRE(test::Refocus(&chosen, params, scene, &a, nullptr, nullptr, &report) == SF_OK);
    REQUIRE(test::Refocus(&told, params, scene, &b) == SF_OK);
    CHECK(report.superblock == config.superblock);
    CHECK(a.bytes == b.bytes);
  }
}

TEST_CASE("workspace: too small or misaligned") {
  Fixture f;
  size_t bytes = 0;
  REQUIRE(sf_workspace_size(&f.config, &bytes) == SF_OK);
  test::Engine legal(f.config);
  REQUIRE(legal.status() == SF_OK);
  uint8_t* workspace = legal.workspace();
  for (size_t size : {size_t{0}, size_t{1}, size_t{64}, bytes / 2, bytes - 1}) {
    sf_engine* engine = legal.get();
    CHECK(sf_init(&f.config, workspace, size, &engine) == SF_ERROR_WORKSPACE);
    CHECK(engine == nullptr);
  }
  std::vector<uint8_t> larger(bytes + 2 * SF_ALIGNMENT);
  const size_t address = reinterpret_cast<uintptr_t>(larger.data());
  uint8_t* aligned = larger.data() + (SF_ALIGNMENT - address % SF_ALIGNMENT) % SF_ALIGNMENT;
  for (int offset : {1, 2, 8, 16, 32, 63}) {
    sf_engine* engine = legal.get();
    CHECK(sf_init(&f.config, aligned + offset, bytes, &engine) == SF_ERROR_WORKSPACE);
    CHECK(engine == nullptr);
  }
  sf_engine* engine = nullptr;
  CHECK(sf_init(&f.config, aligned, bytes + 64, &engine) == SF_OK);
  CHECK(engine != nullptr);
}

// What takes parameters or light fields refuses them alike.
struct Function {
  const char* name;
  bool takes_params, takes_field;
  sf_status (*call)(Fixture* f, sf_engine* e, test::PreparedMemory* memory);
};
const Function kFunctions[] = {
    {"sf_refocus", true, true,
     [](Fixture* f, sf_engine* e, test::PreparedMemory*) { return f->Refocus(e); }},
    {"sf_refocus_prepared", true, false,
     [](Fixture* f, sf_engine* e, test::PreparedMemory* memory) {
       return test::RefocusPreparedRgb(e, &f->params, memory->Prepare(e, f->field),
                                       f->out.bytes.data(), f->out.stride, &f->report);
     }},
    {"sf_stream_begin", true, false,
     [](Fixture* f, sf_engine* e, test::PreparedMemory*) {
       return sf_stream_begin(e, &f->params);
     }},
    {"sf_prepare", false, true,
     [](Fixture* f, sf_engine* e, test::PreparedMemory* memory) {
       sf_prepared* made = nullptr;
       return sf_prepare(e, &f->field, memory->get(), memory->bytes, &made);
     }},
    {"sf_stream_push", false, true,
     [](Fixture* f, sf_engine* e, test::PreparedMemory*) {
       int32_t taken = 0;
       REQUIRE(sf_stream_begin(e, &f->params) == SF_OK);
       const sf_status status = sf_stream_push(e, &f->field, kHeight, &taken);
       CHECK((taken == 0) == (status != SF_OK));
       return status;
     }},
};

TEST_CASE("pictures: illegal parameters and light fields") {
  Fixture f;
  f.config.features |= SF_FEATURE_STREAMING;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == SF_OK);
  test::PreparedMemory memory(f.config);
  const auto check = [&](const auto& bad, const Function& function) {
    CAPTURE(bad.field);
    CHECK(function.call(&f, engine.get(), &memory) == bad.status);
    CheckProblem(bad, sf_engine_problem(engine.get()));
    CHECK(f.NothingWritten());
  };
  for (const Function& function : kFunctions) {
    CAPTURE(function.name);
    for (const Bad<sf_params>& bad : kBadParams) {
      const bool previews = std::string(bad.field) == "preview_shift";
      if (!function.takes_params || (previews && function.call == kFunctions[1].call)) continue;
      f.params = test::Params(0.5);
      bad.spoil(&f.params);
      check(bad, function);
    }
    f.params = test::Params(0.5);
    for (const Bad<sf_light_field>& bad : kBadFields) {
      if (!function.takes_field) continue;
      bad.spoil(&f.field);
      check(bad, function);
      f.field = f.scene.Field();
    }
  }
  f.params = test::Params(6);  // r = 8: exactly the largest blur
  f.params.lens.curvature = 1;
  f.params.lens.ring_inner = SF_MAX_RING_INNER;
  f.params.lens.blades = SF_MAX_BLADES;
  f.params.lens.rotation = 360;
  CHECK(f.Refocus(engine.get()) == SF_OK);
  CHECK(f.report.r_max == 8);
}

TEST_CASE("refocus: null pointers and output stride") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == SF_OK);
  uint8_t* out = f.out.bytes.data();
  const size_t stride = f.out.stride;
  const auto run = [&](sf_engine* e, const sf_params* p, const sf_light_field* l, uint8_t* o,
                       size_t s) { return test::RefocusRgb(e, p, l, o, s, nullptr); };
  CHECK(run(nullptr, &f.params, &f.field, out, stride) == SF_ERROR_NULL);
  CHECK(run(engine.get(), nullptr, &f.field, out, stride) == SF_ERROR_NULL);
  CHECK(run(engine.get(), &f.params, nullptr, out, stride) == SF_ERROR_NULL);
  CHECK(run(engine.get(), &f.params, &f.field, nullptr, stride) == SF_ERROR_NULL);
  for (size_t bad : {size_t{0}, size_t{1}, size_t{59}, kHuge, kHuge / 4}) {
    CHECK(run(engine.get(), &f.params, &f.field, out, bad) == SF_ERROR_STRIDE);
  }
  CHECK(f.NothingWritten());
}

TEST_CASE("refocus: illegal disparity values, wherever they are") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == SF_OK);
  const struct {
    float value;
    sf_status expected;
  } kBad[] = {{kNanF, SF_ERROR_NOT_FINITE},   {kInfF, SF_ERROR_NOT_FINITE},
              {-kInfF, SF_ERROR_NOT_FINITE},  {2.0001f, SF_ERROR_DISPARITY},
              {-2.0001f, SF_ERROR_DISPARITY}, {3e38f, SF_ERROR_DISPARITY},
              {-3e38f, SF_ERROR_DISPARITY}};
  for (const auto& bad : kBad) {
    for (int y : {0, kHeight / 2, kHeight - 1}) {
      for (int x : {0, 7, kWidth - 1}) {
        const float good = f.scene.Disparity(x, y);
        f.scene.Disparity(x, y) = bad.value;
        CHECK(f.Refocus(engine.get()) == bad.expected);
        CHECK(f.NothingWritten());
        f.scene.Disparity(x, y) = good;
      }
    }
  }
  CHECK(f.Refocus(engine.get()) == SF_OK);
}

TEST_CASE("refocus: output may overlap neither the inputs nor the workspace") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == SF_OK);
  const size_t stride = 3 * kWidth;
  const auto run = [&](void* out) {
    return test::RefocusRgb(engine.get(), &f.params, &f.field, static_cast<uint8_t*>(out), stride,
                            nullptr);
  };
  const test::Scene before = f.scene;
  CHECK(run(f.scene.pictures[0].data()) == SF_ERROR_OVERLAP);
  CHECK(run(f.scene.pictures[16].data() + stride * kHeight - 1) == SF_ERROR_OVERLAP);
  CHECK(run(f.scene.disparity.data()) == SF_ERROR_OVERLAP);
  CHECK(run(f.scene.disparity.data() + kWidth * kHeight - 1) == SF_ERROR_OVERLAP);
  CHECK(run(engine.workspace()) == SF_ERROR_OVERLAP);
  CHECK(run(engine.workspace() + engine.bytes() - 1) == SF_ERROR_OVERLAP);
  CHECK(f.scene.pictures == before.pictures);
  CHECK(f.scene.disparity == before.disparity);

  // To the last byte of the map's last row.
  std::vector<float> map(size_t(kWidth * kHeight) + stride * kHeight);
  std::copy(f.scene.disparity.begin(), f.scene.disparity.end(), map.begin());
  f.field.depth.data = map.data();
  uint8_t* const behind = reinterpret_cast<uint8_t*>(map.data() + kWidth * kHeight);
  for (const size_t bytes : {size_t{1}, size_t{3}, size_t{kWidth}, stride - 1, stride}) {
    CHECK(run(behind - bytes) == SF_ERROR_OVERLAP);
  }
  CHECK(run(behind) == SF_OK);

  // Neighbours in memory do not overlap.
  std::vector<uint8_t> joined(3 * stride * kHeight, test::kPoison);
  uint8_t* view = joined.data() + stride * kHeight;
  std::memcpy(view, f.scene.pictures[0].data(), stride * kHeight);
  f.field.views[0].planes[0] = view;
  CHECK(run(joined.data()) == SF_OK);
  CHECK(run(joined.data() + 2 * stride * kHeight) == SF_OK);
  CHECK(run(joined.data() + 1) == SF_ERROR_OVERLAP);
}

TEST_CASE("refocus: the report holds what was rendered") {
  Fixture f;
  test::Engine engine(f.config);
  f.params = test::Params(-3, 0.5);  // r_max = 0.5 * 5
  REQUIRE(f.Refocus(engine.get()) == SF_OK);
  CHECK(f.report.r_max == doctest::Approx(2.5));
  CHECK(f.report.n == 3);
  CHECK(f.report.rendered_views == 29);
  f.params.mode = SF_MODE_BENCHMARK;
  REQUIRE(f.Refocus(engine.get()) == SF_OK);
  CHECK(f.report.n == 6);
  CHECK(f.report.rendered_views == 101);
  CHECK(f.report.rendered_samples > 0);
}

}  // namespace
}  // namespace abi_bytes_test
