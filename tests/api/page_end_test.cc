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
#include <string>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
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
