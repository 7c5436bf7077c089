// SPDX-License-Identifier: Apache-2.0
// Tests starfocus_create, starfocus_prepare and the functions that destroy their results: each
// result is one piece of memory from the allocator, which is released later.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/rgb_calls.h"
#include "tests/support/test_scene.h"

namespace create_test {
namespace {

// Allocator that counts calls, returns memory with arbitrary contents, and checks released memory.
struct Counter {
  int allocations = 0, releases = 0, wrong = 0;
  bool empty = false;
  size_t offset = 0;  // misalignment of the returned memory, bytes
  std::vector<uint8_t> memory;
  void* given = nullptr;
  size_t bytes = 0;
  Counter* next = nullptr;  // if not null, receives the calls for other memory

  starfocus_allocator Allocator() { return {this, Allocate, Release}; }

  static void* Allocate(void* data, size_t bytes, size_t alignment) {
    Counter& self = *static_cast<Counter*>(data);
    if (self.next != nullptr) return Allocate(self.next, bytes, alignment);
    ++self.allocations;
    if (alignment != STARFOCUS_ALIGNMENT) ++self.wrong;
    if (self.empty) return nullptr;
    self.memory.assign(bytes + 2 * alignment, test::kPoison);
    const auto begin = reinterpret_cast<uintptr_t>(self.memory.data());
    const size_t skipped = (alignment - begin % alignment) % alignment + self.offset;
    self.bytes = bytes;
    return self.given = self.memory.data() + skipped;
  }
  static void Release(void* data, void* memory, size_t bytes) {
    Counter& self = *static_cast<Counter*>(data);
    if (self.next != nullptr) return Release(self.next, memory, bytes);
    ++self.releases;
    if (memory != self.given || bytes != self.bytes) ++self.wrong;
    self.memory.assign(self.memory.size(), 0xEE);
  }
};

struct Fixture {
  test::Scene scene = test::RandomScene(70, 50, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 12);
  starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  test::Output expected{70, 50};

  Fixture() {
    test::Engine engine(config);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == STARFOCUS_OK);
  }
  void CheckPicture(starfocus_engine* engine) const {
    const starfocus_light_field field = scene.Field();
    test::Output out(70, 50);
    CHECK(test::RefocusRgb(engine, &params, &field, out.bytes.data(), out.stride, nullptr) ==
          STARFOCUS_OK);
    CHECK(out.bytes == expected.bytes);
  }
};

TEST_CASE("configuration: the missing fields of a shorter structure get their defaults") {
  constexpr uint32_t kShort = offsetof(starfocus_config, superblock);
  std::vector<uint8_t> memory(kShort);
  starfocus_config* const config = reinterpret_cast<starfocus_config*>(memory.data());
  starfocus_defaults("starfocus_config", config, kShort);
  CHECK(config->size == kShort);
  config->width = config->height = 20;
  starfocus_config whole;
  starfocus_config_init(&whole);
  whole.width = whole.height = 20;
  size_t bytes = 0, expected = 0;
  REQUIRE(starfocus_workspace_size(config, &bytes, nullptr) == STARFOCUS_OK);
  REQUIRE(starfocus_workspace_size(&whole, &expected, nullptr) == STARFOCUS_OK);
  CHECK(bytes == expected);
  starfocus_engine* engine = nullptr;
  REQUIRE(starfocus_create(config, nullptr, &engine, nullptr) == STARFOCUS_OK);
  starfocus_destroy(engine);
}

TEST_CASE(
    "configuration: init zeroes unknown fields of a longer structure, and calls reject its size") {
  std::vector<uint8_t> memory(sizeof(starfocus_config) + 24, test::kPoison);
  starfocus_config* const config = reinterpret_cast<starfocus_config*>(memory.data());
  starfocus_defaults("starfocus_config", config, uint32_t(memory.size()));
  CHECK(config->size == memory.size());
  CHECK(std::count(memory.end() - 24, memory.end(), 0) == 24);
  config->width = config->height = 20;
  size_t bytes = 0;
  CHECK(starfocus_workspace_size(config, &bytes, nullptr) == STARFOCUS_ERROR_STRUCTURE);
}

TEST_CASE("create: the only allocation has the size of the workspace and is released once") {
  const Fixture f;
  Counter counter;
  size_t bytes = 0;
  REQUIRE(starfocus_workspace_size(&f.config, &bytes, nullptr) == STARFOCUS_OK);
  starfocus_engine* engine = nullptr;
  {
    // The engine copies the allocator, so the structure may become invalid after starfocus_create.
    const starfocus_allocator allocator = counter.Allocator();
    REQUIRE(starfocus_create(&f.config, &allocator, &engine, nullptr) == STARFOCUS_OK);
  }
  CHECK(counter.bytes == bytes);
  for (int round = 0; round < 2; ++round) f.CheckPicture(engine);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 0);
  starfocus_destroy(engine);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 1);
  CHECK(counter.wrong == 0);
}

TEST_CASE("create: without an allocator, memory comes from the heap and is aligned") {
  const Fixture f;
  std::vector<starfocus_engine*> engines(5);
  for (starfocus_engine*& engine : engines) {
    REQUIRE(starfocus_create(&f.config, nullptr, &engine, nullptr) == STARFOCUS_OK);
    CHECK(reinterpret_cast<uintptr_t>(engine) % STARFOCUS_ALIGNMENT == 0);
  }
  for (starfocus_engine* engine : engines) f.CheckPicture(engine);
  for (starfocus_engine* engine : engines) starfocus_destroy(engine);
}

TEST_CASE(
    "create: if the allocation fails or is misaligned, or after other errors, no memory leaks") {
  Fixture f;
  starfocus_problem problem = {};
  const auto field = [&problem] { return std::string(problem.field); };
  Counter counter;
  const starfocus_allocator allocator = counter.Allocator();
  starfocus_engine* const poison = reinterpret_cast<starfocus_engine*>(&counter);
  starfocus_engine* engine = poison;
  counter.empty = true;
  CHECK(starfocus_create(&f.config, &allocator, &engine, &problem) == STARFOCUS_ERROR_MEMORY);
  CHECK(problem.status == STARFOCUS_ERROR_MEMORY);
  CHECK(field() == "allocator");
  CHECK(engine == nullptr);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 0);

  counter.empty = false;
  counter.offset = 8;
  engine = poison;
  CHECK(starfocus_create(&f.config, &allocator, &engine, &problem) == STARFOCUS_ERROR_WORKSPACE);
  CHECK(engine == nullptr);
  CHECK(counter.releases == 1);
  CHECK(counter.wrong == 0);

  test::Config bad = f.config;
  bad.views = 3;
  engine = poison;
  CHECK(starfocus_create(&bad, &allocator, &engine, &problem) == STARFOCUS_ERROR_RANGE);
  CHECK(engine == nullptr);
  CHECK(starfocus_create(nullptr, &allocator, &engine, &problem) == STARFOCUS_ERROR_NULL);
  CHECK(starfocus_create(&f.config, &allocator, nullptr, &problem) == STARFOCUS_ERROR_NULL);
  CHECK(field() == "engine");
  const starfocus_allocator without[] = {{&counter, nullptr, Counter::Release},
                                         {&counter, Counter::Allocate, nullptr}};
  for (const starfocus_allocator& half : without) {
    CHECK(starfocus_create(&f.config, &half, &engine, &problem) == STARFOCUS_ERROR_NULL);
    CHECK(field() == (half.allocate == nullptr ? "allocator.allocate" : "allocator.release"));
  }
  CHECK(counter.allocations == 2);
}

TEST_CASE("prepare: without memory, the allocator of the engine provides the memory") {
  const Fixture f;
  Counter workspace, counter;
  starfocus_engine* engine = nullptr;
  const starfocus_allocator allocator = workspace.Allocator();
  REQUIRE(starfocus_create(&f.config, &allocator, &engine, nullptr) == STARFOCUS_OK);
  // The memory of the engine stays, and `counter` provides the memory of prepared light fields.
  workspace.next = &counter;
  size_t bytes = 0;
  REQUIRE(starfocus_prepared_size(&f.config, &bytes, nullptr) == STARFOCUS_OK);
  const starfocus_light_field field = f.scene.Field();
  starfocus_prepared* prepared = nullptr;
  REQUIRE(starfocus_prepare(engine, &field, nullptr, 0, &prepared) == STARFOCUS_OK);
  CHECK(counter.bytes == bytes);
  test::Output out(70, 50);
  CHECK(test::RefocusPreparedRgb(engine, &f.params, prepared, out.bytes.data(), out.stride,
                                 nullptr) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
  starfocus_destroy_prepared(prepared);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 1);

  // After an error, the memory is released.
  starfocus_prepared* const poison = prepared;
  test::Scene wrong = f.scene;
  wrong.Disparity(3, 4) = 100;
  const starfocus_light_field bad = wrong.Field();
  CHECK(starfocus_prepare(engine, &bad, nullptr, 0, &prepared) == STARFOCUS_ERROR_DISPARITY);
  CHECK(prepared == nullptr);
  CHECK(counter.allocations == 2);
  CHECK(counter.releases == 2);
  counter.empty = true;
  prepared = poison;
  CHECK(starfocus_prepare(engine, &field, nullptr, 0, &prepared) == STARFOCUS_ERROR_MEMORY);
  CHECK(starfocus_engine_problem(engine)->status == STARFOCUS_ERROR_MEMORY);
  CHECK(prepared == nullptr);
  CHECK(counter.releases == 2);
  CHECK(counter.wrong == 0);
  workspace.next = nullptr;
  starfocus_destroy(engine);
  CHECK(workspace.allocations == 1);
  CHECK(workspace.releases == 1);
  CHECK(workspace.wrong == 0);
}

TEST_CASE("prepare: a prepared light field from the heap may outlive its engine") {
  const Fixture f;
  starfocus_engine* engine = nullptr;
  REQUIRE(starfocus_create(&f.config, nullptr, &engine, nullptr) == STARFOCUS_OK);
  const starfocus_light_field field = f.scene.Field();
  starfocus_prepared* prepared = nullptr;
  REQUIRE(starfocus_prepare(engine, &field, nullptr, 0, &prepared) == STARFOCUS_OK);
  CHECK(reinterpret_cast<uintptr_t>(prepared) % STARFOCUS_ALIGNMENT == 0);
  starfocus_destroy(engine);
  test::Engine other(f.config);
  test::Output out(70, 50);
  CHECK(test::RefocusPreparedRgb(other.get(), &f.params, prepared, out.bytes.data(), out.stride,
                                 nullptr) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
  starfocus_destroy_prepared(prepared);
}

TEST_CASE("prepare: an engine in memory of the caller requires memory of the caller") {
  const Fixture f;
  test::Engine engine(f.config);
  const starfocus_light_field field = f.scene.Field();
  starfocus_prepared* prepared = reinterpret_cast<starfocus_prepared*>(&engine);
  CHECK(starfocus_prepare(engine.get(), &field, nullptr, 0, &prepared) == STARFOCUS_ERROR_NULL);
  CHECK(std::string(starfocus_engine_problem(engine.get())->field) == "memory");
  CHECK(prepared == nullptr);
  test::PreparedMemory memory(engine);
  prepared = memory.Prepare(engine.get(), field);
  starfocus_destroy_prepared(prepared);
  starfocus_destroy_prepared(nullptr);
  test::Output out(70, 50);
  CHECK(test::RefocusPreparedRgb(engine.get(), &f.params, prepared, out.bytes.data(), out.stride,
                                 nullptr) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
}

TEST_CASE("destroy: null pointers are ignored, and memory of the caller is not released") {
  const Fixture f;
  starfocus_destroy(nullptr);
  test::Engine engine(f.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  starfocus_destroy(engine.get());
  f.CheckPicture(engine.get());
}

}  // namespace
}  // namespace create_test
