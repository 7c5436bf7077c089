// SPDX-License-Identifier: Apache-2.0
// Tests the layout and the defaults of the public structures, structures with a field `size` as
// callers pass them whose headers are older or newer than the library, and the facts that the
// library reports about itself.
#include <doctest/doctest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "simd/kernels.h"
#include "starfocus/depth.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "starfocus/version.h"
#include "tests/api/calls.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace structures_test {
namespace {

using namespace calls;

// A page before a page that is not accessible.
class LastPage {
 public:
  LastPage()
      : page_(size_t(sysconf(_SC_PAGESIZE))),
        memory_(
            mmap(nullptr, 2 * page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    REQUIRE(memory_ != MAP_FAILED);
    REQUIRE(mprotect(static_cast<char*>(memory_) + page_, page_, PROT_NONE) == 0);
  }
  LastPage(const LastPage&) = delete;
  LastPage& operator=(const LastPage&) = delete;
  ~LastPage() { munmap(memory_, 2 * page_); }

  // Copies the first `bytes` bytes of a structure to the end of the page, with `size` as the field
  // `size`.
  void* Put(const void* structure, size_t bytes, uint32_t size) {
    char* const at = static_cast<char*>(memory_) + page_ - bytes;
    std::memcpy(at, structure, bytes);
    std::memcpy(at, &size, sizeof size);
    return at;
  }

 private:
  const size_t page_;
  void* const memory_;
};

template <class Type>
const Type* As(void* at) {
  return static_cast<const Type*>(at);
}

// Memory for an engine or for the estimate of a map of the fixture.
struct MapCall {
  explicit MapCall(const Call& c) {
    map.disparity = disparity.data();
    map.disparity_stride = sizeof(float) * size_t(c.f.width);
  }
  uint8_t* Aligned() {
    const auto address = reinterpret_cast<uintptr_t>(room.data());
    return room.data() + (STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT);
  }
  template <class Function>
  starfocus_status Run(Function function, const starfocus_config* config,
                       const starfocus_light_field* field) {
    return function(config, nullptr, field, &map, Aligned(), kBytes, nullptr);
  }

  std::vector<float> disparity = std::vector<float>(1000);
  static constexpr size_t kBytes = size_t{1} << 22;
  std::vector<uint8_t> room = std::vector<uint8_t>(kBytes + STARFOCUS_ALIGNMENT);
  starfocus_disparity_output map = {};
};

using Statuses = std::vector<starfocus_status>;

// Calls with a structure at `at`: of all functions of the set `functions`, with the structure as
// the argument or field `argument` of Call, or else `others`.
struct Row {
  std::string structure;
  unsigned functions;
  std::string argument;
  Statuses (*others)(Call* c, void* at);

  Statuses Run(Call* c, void* at) const {
    if (others != nullptr) return others(c, at);
    c->Pass(argument, at);
    return {c->Run()};
  }
};

const Row kRows[] = {
    {"starfocus_params", kTakesParams, "params", nullptr},
    {"starfocus_study", kTakesParams, "study", nullptr},
    {"starfocus_light_field", kTakesField, "light_field", nullptr},
    {"starfocus_light_field", kAfter, "previous.light_field", nullptr},
    {"starfocus_previous", kAfter, "previous", nullptr},
    {"starfocus_report", kTakesOut, "report", nullptr},
    {"starfocus_params", kRefocus, "",
     [](Call* c, void* at) {
       double aperture = 0;
       return Statuses{starfocus_largest_aperture(c->engine, As<starfocus_params>(at), &aperture)};
     }},
    {"starfocus_observer", kRefocus, "",
     [](Call* c, void* at) {
       starfocus_callbacks callbacks = {};
       callbacks.observer = As<starfocus_observer>(at);
       return Statuses{starfocus_set_callbacks(c->engine, &callbacks)};
     }},
    {"starfocus_tuning", kRefocus, "",
     [](Call* c, void* at) {
       starfocus_config config = c->f.config;
       config.tuning = As<starfocus_tuning>(at);
       return Statuses{starfocus_workspace_size(&config, &c->bytes, nullptr)};
     }},
    {"starfocus_config", kRefocus, "",
     [](Call* c, void* at) {
       const auto* const config = As<starfocus_config>(at);
       MapCall map(*c);
       starfocus_engine* made[2] = {};
       const Statuses statuses = {
           starfocus_workspace_size(config, &c->bytes, nullptr),
           starfocus_prepared_size(config, &c->bytes, nullptr),
           starfocus_map_workspace_size(config, 1, &c->bytes, nullptr),
           starfocus_init(config, map.Aligned(), MapCall::kBytes, &made[0], nullptr),
           starfocus_create(config, nullptr, &made[1], nullptr),
           map.Run(starfocus_estimate_disparity, config, &c->field),
           map.Run(starfocus_repair_disparity, config, &c->field)};
       starfocus_destroy(made[1]);
       return statuses;
     }},
    {"starfocus_light_field", kRefocus, "",
     [](Call* c, void* at) {
       const auto* const field = As<starfocus_light_field>(at);
       return Statuses{MapCall(*c).Run(starfocus_estimate_disparity, &c->f.config, field),
                       MapCall(*c).Run(starfocus_repair_disparity, &c->f.config, field)};
     }},
};

// Returns a legal structure with a name, which belongs to `c`.
const void* WholeOf(const std::string& name, Call* c, starfocus_observer* observer) {
  starfocus_observer_init(observer);
  if (name == "starfocus_config") return static_cast<const starfocus_config*>(&c->f.config);
  if (name == "starfocus_tuning") return &c->f.config.tuning;
  if (name == "starfocus_light_field") return &c->field;
  if (name == "starfocus_params") return static_cast<const starfocus_params*>(&c->params);
  if (name == "starfocus_study") return &c->params.study;
  if (name == "starfocus_previous") return &c->before;
  if (name == "starfocus_report") return &c->report;
  return observer;
}

TEST_CASE("structures: no entry point touches memory after a structure of any size") {
  Fixture f(false);
  LastPage page;
  starfocus_observer observer;
  for (const Row& row : kRows) {
    for (unsigned function = 1; function < kAll; function *= 2) {
      if ((row.functions & function) == 0) continue;
      CAPTURES(&row - kRows, row.structure, function);
      const size_t whole = starfocus_fields(row.structure.c_str(), nullptr, nullptr);
      const auto check = [&](size_t bytes, size_t size, const auto& is_right) {
        CAPTURE(size);
        Call call(&f, function);
        void* const at = page.Put(WholeOf(row.structure, &call, &observer), bytes, uint32_t(size));
        for (const starfocus_status status : row.Run(&call, at)) CHECK(is_right(status));
      };
      const auto is_ok = [](starfocus_status status) { return status == STARFOCUS_OK; };
      const auto is_wrong = [](starfocus_status status) {
        return status == STARFOCUS_ERROR_STRUCTURE;
      };
      check(whole, whole, is_ok);
      for (size_t size = 8; size < whole; size += 8) {
        check(size, size, [&](starfocus_status status) { return !is_wrong(status); });
      }
      if (row.structure == "starfocus_light_field") {
        constexpr size_t kWithoutCoverage = offsetof(starfocus_light_field, coverage);
        check(kWithoutCoverage, kWithoutCoverage, is_ok);
      }
      for (const size_t size : {size_t{0}, size_t{1}, size_t{4}, whole + 8, size_t{UINT32_MAX}}) {
        check(8, size, is_wrong);
      }
    }
  }
}

TEST_CASE("structures: a problem reports a wrong size, and the smallest and the largest size") {
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

TEST_CASE("structures: starfocus_defaults writes only the caller's bytes, and zeros beyond") {
  LastPage page;
  const std::vector<uint8_t> poison(4096, test::kPoison);
  starfocus_config config;
  starfocus_config_init(&config);
  for (const uint32_t size : {4u, 8u, 16u, 400u, 4000u}) {
    auto* const at = static_cast<const uint8_t*>(page.Put(poison.data(), size, size));
    CHECK(starfocus_defaults("starfocus_config", page.Put(poison.data(), size, size), size) ==
          STARFOCUS_OK);
    config.size = size;
    const size_t known = std::min(sizeof config, size_t{size});
    CHECK(std::memcmp(at, &config, known) == 0);
    CHECK(std::count(at + known, at + size, 0) == ptrdiff_t(size - known));
  }
  uint8_t three[3] = {1, 2, 3};
  CHECK(starfocus_defaults("starfocus_config", three, sizeof three) == STARFOCUS_OK);
  CHECK(three[0] == 1);
}

// Copies the first `size` bytes of a structure to the end of a page. The page stays, so that a
// test may use several structures at a time.
template <class Structure>
Structure* Shorter(const Structure& whole, size_t size) {
  static std::vector<std::unique_ptr<LastPage>> pages;
  pages.push_back(std::make_unique<LastPage>());
  return static_cast<Structure*>(pages.back()->Put(&whole, size, uint32_t(size)));
}

TEST_CASE("structures: missing fields of a shorter structure get their defaults") {
  Fixture f(false);
  starfocus_params params;
  starfocus_params_init(&params);
  params.focus = 0.5;
  const starfocus_study study = {sizeof study, STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_SLICES};
  const auto picture_of = [&](const starfocus_params* given, const starfocus_study* mode) {
    Call call(&f, kRefocus);
    starfocus_params lens = params;
    lens.study = mode;
    call.params_at = mode != nullptr ? &lens : given;
    CHECK(call.Run() == STARFOCUS_OK);
    return call.picture;
  };
  const test::ImageMemory expected = picture_of(&params, nullptr);
  CHECK(picture_of(Shorter(params, offsetof(starfocus_params, aperture)), nullptr) == expected);
  const test::ImageMemory blurred = picture_of(nullptr, &study);
  CHECK(!(blurred == expected));
  CHECK(picture_of(nullptr, Shorter(study, offsetof(starfocus_study, renderer))) == blurred);

  size_t whole = 0, bytes = 0;
  starfocus_config config;
  starfocus_config_init(&config);
  config.width = config.height = 20;
  REQUIRE(starfocus_workspace_size(&config, &whole, nullptr) == STARFOCUS_OK);
  const auto check_size = [&](const starfocus_config* given) {
    CHECK(starfocus_workspace_size(given, &bytes, nullptr) == STARFOCUS_OK);
    CHECK(bytes == whole);
  };
  check_size(Shorter(config, offsetof(starfocus_config, superblock)));
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  config.tuning = Shorter(tuning, offsetof(starfocus_tuning, deblocking));
  check_size(&config);

  static int times = 0, blocks = 0;
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.clock = [](void*) { return uint64_t(++times); };
  observer.on_block = [](void*, const starfocus_block*) { ++blocks; };
  starfocus_callbacks callbacks = {};
  callbacks.observer = Shorter(observer, offsetof(starfocus_observer, clock_data));
  REQUIRE(starfocus_set_callbacks(f.engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(picture_of(&params, nullptr) == expected);
  CHECK(times > 0);
  CHECK(blocks == 0);
}

TEST_CASE("structures: a report is filled up to the size of the caller") {
  Fixture f(false);
  starfocus_layer_report layers[STARFOCUS_LAYERS] = {};
  starfocus_report whole = starfocus::NewReport();
  whole.layers = layers;
  const auto fill = [&](starfocus_report* report) {
    Call call(&f, kRefocus);
    call.report_at = report;
    REQUIRE(call.Run() == STARFOCUS_OK);
  };
  fill(&whole);
  CHECK(layers[0].pixels + layers[1].pixels + layers[2].pixels == uint64_t(f.width) * kHeight);
  CHECK(whole.rendered_samples > 0);
  for (const size_t size :
       {offsetof(starfocus_report, n) + sizeof(int32_t),
        offsetof(starfocus_report, gathered_pixels), offsetof(starfocus_report, layers)}) {
    starfocus_report poison;
    std::memset(&poison, test::kPoison, sizeof poison);
    starfocus_report* const report = Shorter(poison, size);
    fill(report);
    whole.size = uint32_t(size);
    CHECK(std::memcmp(report, &whole, size) == 0);
  }
}

// Returns the text of a public header without comments.
std::string TextOf(const std::string& header) {
  std::ifstream file(std::string(STARFOCUS_SOURCE_DIR) + "/lib/include/starfocus/" + header);
  std::string text(std::istreambuf_iterator<char>(file), {});
  for (size_t at = text.find("/*"); at != std::string::npos; at = text.find("/*", at)) {
    text.erase(at, text.find("*/", at) + 2 - at);
  }
  return text;
}

// The names, types and offsets of fields come from the compiler, so that only a field can be
// missing.
TEST_CASE("structures: starfocus_fields lists every field of the headers, in order") {
  const std::regex declaration("typedef struct (starfocus_[a-z_]+) \\{([^}]*)\\}");
  int structures = 0;
  for (const char* header : {"starfocus.h", "experimental.h", "depth.h", "image.h", "matte.h"}) {
    const std::string text = TextOf(header);
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it) {
      const std::string name = (*it)[1], body = (*it)[2];
      CAPTURE(name);
      const starfocus_field* fields = nullptr;
      int32_t count = 0;
      REQUIRE(starfocus_fields(name.c_str(), &fields, &count) > 0);
      CHECK(count == std::count(body.begin(), body.end(), ';'));
      for (int k = 1; k < count; ++k) CHECK(fields[k].offset > fields[k - 1].offset);
      ++structures;
    }
  }
  CHECK(structures >= 24);
  CHECK(starfocus_fields("starfocus_config", nullptr, nullptr) == sizeof(starfocus_config));
  for (const char* name :
       {"", "starfocus_", "starfocus_confi", "starfocus_configs", "starfocus_engine"}) {
    CHECK(starfocus_fields(name, nullptr, nullptr) == 0);
  }
  CHECK(starfocus_fields(nullptr, nullptr, nullptr) == 0);
}

TEST_CASE("structures: fields have the type of the header, and pointers name their structure") {
  const struct {
    std::string structure, field;
    int32_t type;
    std::string target;  // "" if the field neither is nor points to a structure
  } rows[] = {{"starfocus_problem", "status", STARFOCUS_FIELD_INT32, ""},
              {"starfocus_problem", "field", STARFOCUS_FIELD_STRING, ""},
              {"starfocus_config", "positions", STARFOCUS_FIELD_STRUCTURE, "starfocus_position"},
              {"starfocus_callbacks", "runner", STARFOCUS_FIELD_FUNCTION, ""},
              {"starfocus_callbacks", "observer", STARFOCUS_FIELD_POINTER, "starfocus_observer"},
              {"starfocus_allocator", "allocate", STARFOCUS_FIELD_FUNCTION, ""},
              {"starfocus_light_field", "coverage", STARFOCUS_FIELD_POINTER, ""},
              {"starfocus_report", "rendered_samples", STARFOCUS_FIELD_UINT64, ""},
              {"starfocus_report", "layers", STARFOCUS_FIELD_POINTER, "starfocus_layer_report"},
              {"starfocus_disparity_stats", "invalid", STARFOCUS_FIELD_INT64, ""}};
  for (const auto& row : rows) {
    CAPTURES(row.structure, row.field);
    const starfocus_field* fields = nullptr;
    int32_t count = 0;
    REQUIRE(starfocus_fields(row.structure.c_str(), &fields, &count) > 0);
    const auto* const field = std::find_if(
        fields, fields + count, [&](const starfocus_field& one) { return one.name == row.field; });
    REQUIRE(field != fields + count);
    CHECK(field->type == row.type);
    CHECK((field->structure == nullptr ? "" : field->structure) == row.target);
  }
}

TEST_CASE("structures: the defaults match the documentation in the headers") {
  const struct {
    std::string structure, field;
    double value;
  } rows[] = {{"starfocus_config", "size", sizeof(starfocus_config)},
              {"starfocus_config", "max_blur", 32},
              {"starfocus_config", "superblock", 0},
              {"starfocus_config", "max_workers", 1},
              {"starfocus_config", "tuning", 0},
              {"starfocus_config", "unknown", STARFOCUS_UNKNOWN_REFUSE},
              {"starfocus_config", "transfer", STARFOCUS_TRANSFER_SRGB},
              {"starfocus_config", "highlights", 1},
              {"starfocus_config", "features", STARFOCUS_FEATURE_COVERAGE},
              {"starfocus_tuning", "line_scan", 0},
              {"starfocus_tuning", "max_layer", 2},
              {"starfocus_tuning", "deblocking", 35},
              {"starfocus_tuning", "n_scale", 1},
              {"starfocus_tuning", "gather", 1},
              {"starfocus_study", "mode", STARFOCUS_MODE_BLOCK},
              {"starfocus_study", "renderer", STARFOCUS_RENDERER_AUTO},
              {"starfocus_params", "size", sizeof(starfocus_params)},
              {"starfocus_params", "study", 0},
              {"starfocus_params", "aperture", 1},
              {"starfocus_params", "focus", 0},
              {"starfocus_params", "focus_nearer", 0},
              {"starfocus_params", "focus_farther", 0},
              {"starfocus_params", "shape", STARFOCUS_SHAPE_FALL_OFF},
              {"starfocus_params", "theta", 0.26 * 3.14159265358979},
              {"starfocus_params", "blades", 5},
              {"starfocus_params", "rotation", 0},
              {"starfocus_params", "curvature", 0},
              {"starfocus_params", "ring_inner", 0.5},
              {"starfocus_params", "cats_eye", 0},
              {"starfocus_params", "region.width", 0}};
  for (const auto& row : rows) {
    CAPTURES(row.structure, row.field);
    std::vector<uint8_t> memory(starfocus_fields(row.structure.c_str(), nullptr, nullptr),
                                test::kPoison);
    REQUIRE(starfocus_defaults(row.structure.c_str(), memory.data(), uint32_t(memory.size())) ==
            STARFOCUS_OK);
    const double value = FieldAt(row.structure, memory.data(), row.field).Get();
    CHECK(value == doctest::Approx(row.value).epsilon(1e-12));
  }
}

TEST_CASE("facts: the version of the library is the version of the headers") {
  uint32_t abi = 0;
  CHECK(starfocus_version(&abi) == std::string(STARFOCUS_VERSION_STRING));
  CHECK(abi == STARFOCUS_ABI);
}

TEST_CASE(
    "facts: starfocus_view_position returns the documented positions for star sets of views") {
  const double kExpected[STARFOCUS_MAX_VIEWS][2] = {
      {0, 0},    {1, 0},     {-1, 0},     {0, 1},      {0, -1},     {1, 1},
      {-1, 1},   {1, -1},    {-1, -1},    {0.5, 0},    {-0.5, 0},   {0, 0.5},
      {0, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  double u = 7, v = 7;
  for (const int view : {-1, STARFOCUS_MAX_VIEWS, INT32_MAX, INT32_MIN}) {
    CHECK(starfocus_view_position(view, &u, &v, nullptr) == STARFOCUS_ERROR_RANGE);
  }
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

TEST_CASE("facts: starfocus_simd_target returns the name of the kernels that the engine uses") {
  CHECK(std::string(starfocus_simd_target()) == starfocus::simd::BestKernels().name);
  CHECK(*starfocus_simd_target() != '\0');
}

TEST_CASE("facts: each status has a unique description, and other numbers are unknown") {
  // Words that appear only in the description of one status.
  const std::map<int, std::string> words = {
      {STARFOCUS_OK, "success"},
      {STARFOCUS_ERROR_NULL, "pointer is null"},
      {STARFOCUS_ERROR_STRUCTURE, "init function"},
      {STARFOCUS_ERROR_RANGE, "outside its range"},
      {STARFOCUS_ERROR_FEATURE, "needs a feature"},
      {STARFOCUS_ERROR_STATE, "starfocus_stream_begin"},
      {STARFOCUS_ERROR_WORKSPACE, "STARFOCUS_ALIGNMENT"},
      {STARFOCUS_ERROR_TOO_LARGE, "can address"},
      {STARFOCUS_ERROR_MEMORY, "out of memory"},
      {STARFOCUS_ERROR_STRIDE, "stride is smaller"},
      {STARFOCUS_ERROR_OVERLAP, "overlaps"},
      {STARFOCUS_ERROR_BLUR, "exceeds max_blur"},
      {STARFOCUS_ERROR_DISPARITY, "outside the configured disparity range"},
      {STARFOCUS_ERROR_NOT_FINITE, "NaN or infinity"},
      {STARFOCUS_ERROR_ALL_INVALID, "no finite value"},
      {STARFOCUS_ERROR_PREPARED, "prepared light field"},
      {STARFOCUS_ERROR_RUNNER, "runner"},
      {STARFOCUS_ERROR_CANCELLED, "cancelled"}};
  const std::string header = TextOf("starfocus.h");
  const std::regex error("STARFOCUS_ERROR_\\w+ = ");
  const std::sregex_iterator first(header.begin(), header.end(), error), last;
  CHECK(std::distance(first, last) == ptrdiff_t(words.size()) - 1);
  for (int number = -1000; number <= 1000; ++number) {
    const std::string sentence = starfocus_status_string(static_cast<starfocus_status>(number));
    CAPTURES(number, sentence);
    CHECK((sentence == "unknown status") == (words.count(number) == 0));
    for (const auto& one : words) {
      CAPTURE(one.second);
      CHECK((sentence.find(one.second) != std::string::npos) == (one.first == number));
    }
  }
}

TEST_CASE("facts: starfocus_plane_size returns 0 for planes that the format does not have") {
  const struct {
    starfocus_format format;
    int32_t rows[3];
    size_t row_bytes[3];
  } rows[] = {{STARFOCUS_FORMAT_RGB, {5, 0, 0}, {21, 0, 0}},
              {STARFOCUS_FORMAT_BGRX, {5, 0, 0}, {28, 0, 0}},
              {STARFOCUS_FORMAT_NV12, {5, 3, 0}, {7, 8, 0}},
              {STARFOCUS_FORMAT_I420, {5, 3, 3}, {7, 4, 4}}};
  int32_t count = -1;
  size_t bytes = 0;
  starfocus_problem problem;
  for (const auto& row : rows) {
    starfocus_image image = {};
    image.format = row.format;
    for (int plane = -1; plane < 4; ++plane) {
      CAPTURES(row.format, plane);
      const starfocus_status status =
          starfocus_plane_size(&image, plane, 7, 5, &count, &bytes, &problem);
      if (plane < 0 || plane > 2) {
        CHECK(status == STARFOCUS_ERROR_RANGE);
        CHECK(problem.field == std::string("plane"));
        continue;
      }
      CHECK(status == STARFOCUS_OK);
      CHECK(count == row.rows[plane]);
      CHECK(bytes == row.row_bytes[plane]);
    }
  }
}

}  // namespace
}  // namespace structures_test
