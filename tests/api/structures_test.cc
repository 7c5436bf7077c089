// SPDX-License-Identifier: Apache-2.0
// Tests that no entry point reads or writes a byte after the end of a structure with a field
// `size`, whatever size the caller's header has. The structures end at the end of a page, and the
// next page is not accessible.
#include <doctest/doctest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "starfocus/version.h"
#include "tests/support/config.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace page_end_test {
namespace {

constexpr int kWidth = 20, kHeight = 12;

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

// Legal arguments of all entry points.
struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -2, 2, 1);
  test::Config config = StreamingConfig();
  starfocus_tuning tuning = config.tuning;
  test::Engine engine{config};
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight}, before{kWidth, kHeight};
  starfocus_image image = starfocus_image_rgb(out.bytes.data(), out.stride);
  starfocus_image image_before = starfocus_image_rgb(before.bytes.data(), before.stride);
  starfocus_params params;
  starfocus_study study;
  starfocus_previous previous = {sizeof previous, &field, &image_before};
  starfocus_report report;
  starfocus_observer observer;
  test::PreparedMemory memory{engine}, spare{engine};
  starfocus_prepared* prepared = memory.Prepare(engine.get(), field);
  std::vector<float> disparity = std::vector<float>(kWidth * kHeight);
  starfocus_disparity_output map = {};
  std::vector<uint8_t> room;
  size_t bytes = 0;
  int32_t count = 0;

  Fixture() {
    starfocus_params_init(&params);
    starfocus_study_init(&study);
    starfocus_report_init(&report);
    starfocus_observer_init(&observer);
    map.disparity = disparity.data();
    map.disparity_stride = sizeof(float) * kWidth;
    size_t most = 0;
    for (const int32_t repairs : {0, 1}) {
      REQUIRE(starfocus_map_workspace_size(&config, repairs, &bytes, nullptr) == STARFOCUS_OK);
      most = std::max(most, bytes);
    }
    REQUIRE(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    room.resize(std::max(most, bytes) + STARFOCUS_ALIGNMENT);
  }
  test::Config StreamingConfig() const {
    test::Config made = test::ConfigFor(scene, 8);
    made.features |= STARFOCUS_FEATURE_STREAMING;
    return made;
  }
  uint8_t* Workspace() {
    const auto address = reinterpret_cast<uintptr_t>(room.data());
    return room.data() + (STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT);
  }
  size_t WorkspaceBytes() const { return room.size() - STARFOCUS_ALIGNMENT; }
  void Begin() { REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK); }

  const void* Structure(const std::string& name) const {
    if (name == "starfocus_config") return static_cast<const starfocus_config*>(&config);
    if (name == "starfocus_tuning") return &tuning;
    if (name == "starfocus_light_field") return &field;
    if (name == "starfocus_params") return &params;
    if (name == "starfocus_study") return &study;
    if (name == "starfocus_previous") return &previous;
    if (name == "starfocus_report") return &report;
    return &observer;
  }
};

// A call with a structure at `at`.
struct Row {
  const char* structure;
  starfocus_status (*call)(Fixture& f, void* at);
};

const starfocus_config* Config(void* at) { return static_cast<const starfocus_config*>(at); }
const starfocus_params* Params(void* at) { return static_cast<const starfocus_params*>(at); }
starfocus_report* Report(void* at) { return static_cast<starfocus_report*>(at); }
const starfocus_light_field* Field(void* at) {
  return static_cast<const starfocus_light_field*>(at);
}

const Row kRows[] = {
    {"starfocus_config",
     [](Fixture& f, void* at) { return starfocus_workspace_size(Config(at), &f.bytes, nullptr); }},
    {"starfocus_config",
     [](Fixture& f, void* at) { return starfocus_prepared_size(Config(at), &f.bytes, nullptr); }},
    {"starfocus_config",
     [](Fixture& f, void* at) {
       return starfocus_map_workspace_size(Config(at), 1, &f.bytes, nullptr);
     }},
    {"starfocus_config",
     [](Fixture& f, void* at) {
       starfocus_engine* made = nullptr;
       return starfocus_init(Config(at), f.Workspace(), f.WorkspaceBytes(), &made, nullptr);
     }},
    {"starfocus_config",
     [](Fixture&, void* at) {
       starfocus_engine* made = nullptr;
       const starfocus_status status = starfocus_create(Config(at), nullptr, &made, nullptr);
       starfocus_destroy(made);
       return status;
     }},
    {"starfocus_config",
     [](Fixture& f, void* at) {
       return starfocus_estimate_disparity(Config(at), nullptr, &f.field, &f.map, f.Workspace(),
                                           f.WorkspaceBytes(), nullptr);
     }},
    {"starfocus_config",
     [](Fixture& f, void* at) {
       return starfocus_repair_disparity(Config(at), nullptr, &f.field, &f.map, f.Workspace(),
                                         f.WorkspaceBytes(), nullptr);
     }},
    {"starfocus_tuning",
     [](Fixture& f, void* at) {
       starfocus_config config = f.config;
       config.tuning = static_cast<const starfocus_tuning*>(at);
       return starfocus_workspace_size(&config, &f.bytes, nullptr);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       return starfocus_refocus(f.engine.get(), &f.params, Field(at), &f.image, nullptr);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       starfocus_prepared* made = nullptr;
       return starfocus_prepare(f.engine.get(), Field(at), f.spare.get(), f.spare.bytes, &made);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       f.Begin();
       return starfocus_stream_push(f.engine.get(), Field(at), kHeight, &f.count);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       return starfocus_estimate_disparity(&f.config, nullptr, Field(at), &f.map, f.Workspace(),
                                           f.WorkspaceBytes(), nullptr);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       return starfocus_repair_disparity(&f.config, nullptr, Field(at), &f.map, f.Workspace(),
                                         f.WorkspaceBytes(), nullptr);
     }},
    {"starfocus_light_field",
     [](Fixture& f, void* at) {
       const starfocus_previous previous = {sizeof previous, Field(at), &f.image_before};
       starfocus_params params = f.params;
       params.previous = &previous;
       return starfocus_refocus(f.engine.get(), &params, &f.field, &f.image, nullptr);
     }},
    {"starfocus_params",
     [](Fixture& f, void* at) {
       return starfocus_refocus(f.engine.get(), Params(at), &f.field, &f.image, nullptr);
     }},
    {"starfocus_params",
     [](Fixture& f, void* at) {
       return starfocus_refocus_prepared(f.engine.get(), Params(at), f.prepared, &f.image, nullptr);
     }},
    {"starfocus_params",
     [](Fixture& f, void* at) { return starfocus_stream_begin(f.engine.get(), Params(at)); }},
    {"starfocus_params",
     [](Fixture& f, void* at) {
       double aperture = 0;
       return starfocus_largest_aperture(f.engine.get(), Params(at), &aperture);
     }},
    {"starfocus_study",
     [](Fixture& f, void* at) {
       starfocus_params params = f.params;
       params.study = static_cast<const starfocus_study*>(at);
       return starfocus_refocus(f.engine.get(), &params, &f.field, &f.image, nullptr);
     }},
    {"starfocus_previous",
     [](Fixture& f, void* at) {
       starfocus_params params = f.params;
       params.previous = static_cast<const starfocus_previous*>(at);
       return starfocus_refocus(f.engine.get(), &params, &f.field, &f.image, nullptr);
     }},
    {"starfocus_report",
     [](Fixture& f, void* at) {
       return starfocus_refocus(f.engine.get(), &f.params, &f.field, &f.image, Report(at));
     }},
    {"starfocus_report",
     [](Fixture& f, void* at) {
       return starfocus_refocus_prepared(f.engine.get(), &f.params, f.prepared, &f.image,
                                         Report(at));
     }},
    {"starfocus_report",
     [](Fixture& f, void* at) {
       f.Begin();
       REQUIRE(starfocus_stream_push(f.engine.get(), &f.field, kHeight, &f.count) == STARFOCUS_OK);
       return starfocus_stream_pull(f.engine.get(), &f.image, kHeight, &f.count, Report(at));
     }},
    {"starfocus_observer",
     [](Fixture& f, void* at) {
       starfocus_callbacks callbacks = {};
       callbacks.observer = static_cast<const starfocus_observer*>(at);
       return starfocus_set_callbacks(f.engine.get(), &callbacks);
     }},
};

TEST_CASE("no entry point touches memory after a structure of any size") {
  Fixture f;
  LastPage page;
  for (const Row& row : kRows) {
    CAPTURE(&row - kRows);
    CAPTURE(row.structure);
    const void* const whole = f.Structure(row.structure);
    const size_t bytes = starfocus_fields(row.structure, nullptr, nullptr);
    CHECK(row.call(f, page.Put(whole, bytes, uint32_t(bytes))) == STARFOCUS_OK);
    for (size_t size = 8; size < bytes; size += 8) {
      CAPTURE(size);
      CHECK(row.call(f, page.Put(whole, size, uint32_t(size))) != STARFOCUS_ERROR_STRUCTURE);
    }
    for (const uint32_t size : {0u, 1u, 4u, uint32_t(bytes) + 8, 9999u, UINT32_MAX}) {
      CAPTURE(size);
      CHECK(row.call(f, page.Put(whole, 8, size)) == STARFOCUS_ERROR_STRUCTURE);
    }
  }
}

TEST_CASE("starfocus_defaults writes only the caller's bytes") {
  LastPage page;
  const std::vector<uint8_t> poison(4096, test::kPoison);
  for (const uint32_t size : {4u, 8u, 16u, 400u, 4000u}) {
    void* const at = page.Put(poison.data(), size, size);
    CHECK(starfocus_defaults("starfocus_config", at, size) == STARFOCUS_OK);
    uint32_t found;
    std::memcpy(&found, at, sizeof found);
    CHECK(found == size);
  }
  uint8_t three[3] = {1, 2, 3};
  CHECK(starfocus_defaults("starfocus_config", three, sizeof three) == STARFOCUS_OK);
  CHECK(three[0] == 1);
}

}  // namespace
}  // namespace page_end_test

// Tests structures with a field `size` as callers pass them whose headers are older or newer than
// the library. Every structure is in memory of exactly its size, so that sanitizers find reads and
// writes beyond its end.

namespace older_test {
namespace {

constexpr int kWidth = 70, kHeight = 50;

// The first `size` bytes of a structure, or the structure and `rest` in the bytes after it.
template <class Structure>
class Sized {
 public:
  Sized(const Structure& whole, size_t size, uint8_t rest = 0) : memory_(std::max(size, kLeast)) {
    std::fill(memory_.begin(), memory_.end(), rest);
    std::memcpy(memory_.data(), &whole, std::min(memory_.size(), sizeof whole));
    const auto given = uint32_t(size);
    std::memcpy(memory_.data(), &given, sizeof given);
  }
  Structure* get() { return reinterpret_cast<Structure*>(memory_.data()); }

 private:
  static constexpr size_t kLeast = sizeof(uint32_t);
  std::vector<uint8_t> memory_;
};

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 12);
  test::Engine engine{config};
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight};
  starfocus_image image = starfocus_image_rgb(out.bytes.data(), out.stride);
  starfocus_params params;
  std::vector<uint8_t> expected;

  Fixture() {
    starfocus_params_init(&params);
    params.focus = 2;
    expected = Refocus(&params, &field, nullptr);
  }
  std::vector<uint8_t> Refocus(const starfocus_params* lens, const starfocus_light_field* given,
                               starfocus_report* report) {
    std::fill(out.bytes.begin(), out.bytes.end(), test::kPoison);
    REQUIRE(starfocus_refocus(engine.get(), lens, given, &image, report) == STARFOCUS_OK);
    return out.bytes;
  }
};

TEST_CASE("older: missing fields of parameters and light fields get their defaults") {
  Fixture f;
  Sized<starfocus_params> lens(f.params, offsetof(starfocus_params, aperture));
  Sized<starfocus_light_field> field(f.field, offsetof(starfocus_light_field, coverage));
  CHECK(f.Refocus(lens.get(), field.get(), nullptr) == f.expected);
  starfocus_study study = {sizeof study, STARFOCUS_MODE_BLUR, STARFOCUS_RENDERER_SLICES};
  f.params.study = &study;
  const std::vector<uint8_t> blurred = f.Refocus(&f.params, &f.field, nullptr);
  Sized<starfocus_study> shorter(study, offsetof(starfocus_study, renderer));
  f.params.study = shorter.get();
  CHECK(f.Refocus(&f.params, &f.field, nullptr) == blurred);
}

TEST_CASE("older: a report is filled up to the size of the caller") {
  Fixture f;
  starfocus_layer_report layers[STARFOCUS_LAYERS] = {};
  starfocus_report whole;
  starfocus_report_init(&whole);
  whole.layers = layers;
  f.Refocus(&f.params, &f.field, &whole);
  CHECK(layers[0].pixels + layers[1].pixels + layers[2].pixels == kWidth * kHeight);
  CHECK(whole.rendered_samples > 0);
  for (const size_t size :
       {offsetof(starfocus_report, n) + sizeof(int32_t),
        offsetof(starfocus_report, gathered_pixels), offsetof(starfocus_report, layers)}) {
    starfocus_report poison;
    std::memset(&poison, test::kPoison, sizeof poison);
    Sized<starfocus_report> report(poison, size), full(whole, size);
    f.Refocus(&f.params, &f.field, report.get());
    CHECK(std::memcmp(report.get(), full.get(), size) == 0);
  }
}

TEST_CASE("older: light fields without coverage can be compared, prepared, pushed and estimated") {
  Fixture f;
  Sized<starfocus_light_field> field(f.field, offsetof(starfocus_light_field, coverage));
  const std::vector<uint8_t> before = f.expected;
  const starfocus_image before_image = starfocus_image_rgb(before.data(), f.out.stride);
  const starfocus_previous previous = {sizeof previous, field.get(), &before_image};
  starfocus_params after = f.params;
  after.previous = &previous;
  starfocus_report report;
  starfocus_report_init(&report);
  CHECK(f.Refocus(&after, field.get(), &report) == f.expected);
  CHECK(report.reused_blocks == 2);

  test::PreparedMemory memory(f.engine);
  starfocus_prepared* prepared = memory.Prepare(f.engine.get(), *field.get());
  CHECK(starfocus_refocus_prepared(f.engine.get(), &f.params, prepared, &f.image, nullptr) ==
        STARFOCUS_OK);
  CHECK(f.out.bytes == f.expected);

  test::Config streaming = f.config;
  streaming.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine stream(streaming);
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_begin(stream.get(), &f.params) == STARFOCUS_OK);
  CHECK(starfocus_stream_push(stream.get(), field.get(), kHeight, &consumed) == STARFOCUS_OK);
  CHECK(consumed == kHeight);

  size_t bytes = 0;
  REQUIRE(starfocus_map_workspace_size(&f.config, 0, &bytes, nullptr) == STARFOCUS_OK);
  std::vector<uint8_t> room(bytes + STARFOCUS_ALIGNMENT);
  uint8_t* workspace = room.data();
  while (reinterpret_cast<uintptr_t>(workspace) % STARFOCUS_ALIGNMENT != 0) ++workspace;
  std::vector<float> map(kWidth * kHeight);
  starfocus_disparity_output output = {};
  output.disparity = map.data();
  output.disparity_stride = sizeof(float) * kWidth;
  CHECK(starfocus_estimate_disparity(&f.config, nullptr, field.get(), &output, workspace, bytes,
                                     nullptr) == STARFOCUS_OK);
}

int blocks = 0, times = 0;

TEST_CASE("older: missing fields of tuning and observer get their defaults") {
  Fixture f;
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  Sized<starfocus_tuning> shorter(tuning, offsetof(starfocus_tuning, deblocking));
  starfocus_config config = f.config;
  config.tuning = &tuning;
  size_t expected = 0, bytes = 0;
  CHECK(starfocus_workspace_size(&config, &expected, nullptr) == STARFOCUS_OK);
  config.tuning = shorter.get();
  CHECK(starfocus_workspace_size(&config, &bytes, nullptr) == STARFOCUS_OK);
  CHECK(bytes == expected);

  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.clock = [](void*) { return uint64_t(++times); };
  observer.on_block = [](void*, const starfocus_block*) { ++blocks; };
  Sized<starfocus_observer> clock(observer, offsetof(starfocus_observer, clock_data));
  starfocus_callbacks callbacks = {};
  callbacks.observer = clock.get();
  REQUIRE(starfocus_set_callbacks(f.engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(f.Refocus(&f.params, &f.field, nullptr) == f.expected);
  CHECK(times > 0);
  CHECK(blocks == 0);
}

// Checks that call(structure) accepts `whole` and rejects it with sizes that no header has, and
// with the size of a newer header, whether or not its unknown fields are 0.
template <class Structure, class Call>
void CheckSizes(const Structure& whole, const Call& call) {
  Sized<Structure> right(whole, sizeof whole);
  CHECK(call(right.get()) == STARFOCUS_OK);
  for (const size_t size : {size_t{0}, size_t{3}, sizeof(uint32_t), sizeof whole + 8}) {
    for (const uint8_t rest : {uint8_t{0}, uint8_t{1}}) {
      Sized<Structure> wrong(whole, size, rest);
      CHECK(call(wrong.get()) == STARFOCUS_ERROR_STRUCTURE);
    }
  }
}

TEST_CASE("older: sizes that no header has, and sizes of newer headers, are rejected") {
  Fixture f;
  size_t bytes = 0;
  starfocus_config config = f.config;
  const auto size_of = [&](const starfocus_config* given) {
    return starfocus_workspace_size(given, &bytes, nullptr);
  };
  CheckSizes(config, size_of);
  starfocus_tuning tuning;
  starfocus_tuning_init(&tuning);
  CheckSizes(tuning, [&](const starfocus_tuning* given) {
    config.tuning = given;
    return size_of(&config);
  });
  starfocus_report report;
  starfocus_report_init(&report);
  const auto refocus = [&](const starfocus_params* lens, const starfocus_light_field* field,
                           starfocus_report* to) {
    return starfocus_refocus(f.engine.get(), lens, field, &f.image, to);
  };
  CheckSizes(f.params, [&](auto* given) { return refocus(given, &f.field, nullptr); });
  CheckSizes(f.field, [&](auto* given) { return refocus(&f.params, given, nullptr); });
  CheckSizes(report, [&](auto* given) { return refocus(&f.params, &f.field, given); });
  starfocus_study study;
  starfocus_study_init(&study);
  starfocus_params lens = f.params;
  CheckSizes(study, [&](const starfocus_study* given) {
    lens.study = given;
    return refocus(&lens, &f.field, nullptr);
  });
  const starfocus_image before = starfocus_image_rgb(f.expected.data(), f.out.stride);
  starfocus_previous previous = {sizeof previous, &f.field, &before};
  lens = f.params;
  CheckSizes(previous, [&](const starfocus_previous* given) {
    lens.previous = given;
    return refocus(&lens, &f.field, nullptr);
  });
  lens.previous = &previous;
  CheckSizes(f.field, [&](const starfocus_light_field* given) {
    previous.light_field = given;
    return refocus(&lens, &f.field, nullptr);
  });
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  CheckSizes(observer, [&](const starfocus_observer* given) {
    starfocus_callbacks callbacks = {};
    callbacks.observer = given;
    return starfocus_set_callbacks(f.engine.get(), &callbacks);
  });
}

}  // namespace
}  // namespace older_test

// Tests the version, structure sizes, defaults and view positions that the library reports.

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
