// SPDX-License-Identifier: Apache-2.0
// Tests where the memory of the library comes from. The results of starfocus_create and
// starfocus_prepare are one piece of memory each from the allocator, which is released later.
// symbols_test checks that no other function can allocate memory on the heap.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/images.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace memory_test {
namespace {

// Allocator that counts calls, returns memory with arbitrary contents, and checks released memory.
struct Counter {
  int allocations = 0, releases = 0, wrong = 0;
  bool empty = false;
  size_t offset = 0;  // misalignment of the returned memory, bytes
  size_t bytes = 0;   // size of the last allocation
  std::map<void*, std::vector<uint8_t>> memory;
  std::map<void*, size_t> given;

  starfocus_allocator Allocator() { return {this, Allocate, Release}; }
  bool Did(int expected_allocations, int expected_releases) const {
    return allocations == expected_allocations && releases == expected_releases && wrong == 0;
  }

  static void* Allocate(void* data, size_t bytes, size_t alignment) {
    Counter& self = *static_cast<Counter*>(data);
    ++self.allocations;
    if (alignment != STARFOCUS_ALIGNMENT) ++self.wrong;
    if (self.empty) return nullptr;
    std::vector<uint8_t> block(bytes + 2 * alignment, test::kPoison);
    const auto begin = reinterpret_cast<uintptr_t>(block.data());
    uint8_t* const at = block.data() + (alignment - begin % alignment) % alignment + self.offset;
    self.memory[at] = std::move(block);
    self.given[at] = self.bytes = bytes;
    return at;
  }
  static void Release(void* data, void* memory, size_t bytes) {
    Counter& self = *static_cast<Counter*>(data);
    ++self.releases;
    if (self.given.count(memory) == 0 || self.given[memory] != bytes) ++self.wrong;
    self.given.erase(memory);
    std::vector<uint8_t>& block = self.memory[memory];
    std::fill(block.begin(), block.end(), 0xEE);
  }
};

struct Fixture {
  test::Scene scene = test::RandomScene(70, 50, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 12);
  starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field field = scene.Field();
  test::Output expected = test::OutputOf(config, params, scene);

  starfocus_engine* Create(const starfocus_allocator* allocator) const {
    starfocus_engine* engine = nullptr;
    REQUIRE(starfocus_create(&config, allocator, &engine, nullptr) == STARFOCUS_OK);
    CHECK(reinterpret_cast<uintptr_t>(engine) % STARFOCUS_ALIGNMENT == 0);
    return engine;
  }
  starfocus_prepared* Prepare(starfocus_engine* engine) const {
    starfocus_prepared* prepared = nullptr;
    REQUIRE(starfocus_prepare(engine, &field, nullptr, 0, &prepared) == STARFOCUS_OK);
    CHECK(reinterpret_cast<uintptr_t>(prepared) % STARFOCUS_ALIGNMENT == 0);
    return prepared;
  }
  // Checks the picture of an engine, from a prepared light field if there is one.
  void CheckPicture(starfocus_engine* engine, const starfocus_prepared* prepared = nullptr) const {
    test::Output out(70, 50);
    uint8_t* const to = out.bytes.data();
    CHECK((prepared == nullptr ? test::RefocusRgb(engine, &params, &field, to, out.stride, nullptr)
                               : test::RefocusPreparedRgb(engine, &params, prepared, to, out.stride,
                                                          nullptr)) == STARFOCUS_OK);
    CHECK(out.bytes == expected.bytes);
  }
};

TEST_CASE("create: the only allocation has the size of the workspace and is released once") {
  const Fixture f;
  Counter counter;
  size_t bytes = 0;
  REQUIRE(starfocus_workspace_size(&f.config, &bytes, nullptr) == STARFOCUS_OK);
  // The engine copies the allocator, so the structure may become invalid after starfocus_create.
  auto allocator = std::make_unique<starfocus_allocator>(counter.Allocator());
  starfocus_engine* const engine = f.Create(allocator.get());
  allocator.reset();
  CHECK(counter.bytes == bytes);
  for (int round = 0; round < 2; ++round) f.CheckPicture(engine);
  CHECK(counter.Did(1, 0));
  starfocus_destroy(engine);
  CHECK(counter.Did(1, 1));
}

TEST_CASE("create: without an allocator, memory comes from the heap, and may outlive its engine") {
  const Fixture f;
  std::vector<starfocus_engine*> engines;
  for (int k = 0; k < 5; ++k) engines.push_back(f.Create(nullptr));
  for (starfocus_engine* engine : engines) f.CheckPicture(engine);
  starfocus_prepared* const prepared = f.Prepare(engines[0]);
  for (starfocus_engine* engine : engines) starfocus_destroy(engine);
  const test::Engine other(f.config);
  f.CheckPicture(other.get(), prepared);
  starfocus_destroy_prepared(prepared);
}

TEST_CASE("create: after a failed or misaligned allocation and other errors, no memory leaks") {
  const Fixture f;
  Counter counter;
  const starfocus_allocator allocator = counter.Allocator();
  const starfocus_allocator halves[] = {{&counter, nullptr, Counter::Release},
                                        {&counter, Counter::Allocate, nullptr}};
  test::Config bad = f.config;
  bad.views = 3;
  const auto check = [&](const starfocus_config* config, const starfocus_allocator* from,
                         starfocus_status status, const std::string& field) {
    starfocus_engine* engine = reinterpret_cast<starfocus_engine*>(&counter);
    starfocus_problem problem = {};
    CHECK(starfocus_create(config, from, &engine, &problem) == status);
    CHECK(problem.status == status);
    CHECK(problem.field == field);
    CHECK(engine == nullptr);
  };
  counter.empty = true;
  check(&f.config, &allocator, STARFOCUS_ERROR_MEMORY, "allocator");
  CHECK(counter.Did(1, 0));
  counter.empty = false;
  counter.offset = 8;
  check(&f.config, &allocator, STARFOCUS_ERROR_WORKSPACE, "workspace");
  CHECK(counter.Did(2, 1));
  check(&bad, &allocator, STARFOCUS_ERROR_RANGE, "views");
  check(nullptr, &allocator, STARFOCUS_ERROR_NULL, "config");
  check(&f.config, &halves[0], STARFOCUS_ERROR_NULL, "allocator.allocate");
  check(&f.config, &halves[1], STARFOCUS_ERROR_NULL, "allocator.release");
  starfocus_problem problem = {};
  CHECK(starfocus_create(&f.config, &allocator, nullptr, &problem) == STARFOCUS_ERROR_NULL);
  CHECK(problem.field == std::string("engine"));
  CHECK(counter.Did(2, 1));
}

TEST_CASE("prepare: without memory, the allocator of the engine provides the memory") {
  Fixture f;
  Counter counter;
  const starfocus_allocator allocator = counter.Allocator();
  starfocus_engine* const engine = f.Create(&allocator);
  size_t bytes = 0;
  REQUIRE(starfocus_prepared_size(&f.config, &bytes, nullptr) == STARFOCUS_OK);
  starfocus_prepared* prepared = f.Prepare(engine);
  CHECK(counter.bytes == bytes);
  f.CheckPicture(engine, prepared);
  starfocus_destroy_prepared(prepared);
  CHECK(counter.Did(2, 1));

  // After an error, the memory is released.
  f.scene.Disparity(3, 4) = 100;
  CHECK(starfocus_prepare(engine, &f.field, nullptr, 0, &prepared) == STARFOCUS_ERROR_DISPARITY);
  CHECK(prepared == nullptr);
  CHECK(counter.Did(3, 2));
  counter.empty = true;
  prepared = reinterpret_cast<starfocus_prepared*>(&counter);
  CHECK(starfocus_prepare(engine, &f.field, nullptr, 0, &prepared) == STARFOCUS_ERROR_MEMORY);
  CHECK(starfocus_engine_problem(engine)->status == STARFOCUS_ERROR_MEMORY);
  CHECK(prepared == nullptr);
  CHECK(counter.Did(4, 2));
  starfocus_destroy(engine);
  CHECK(counter.Did(4, 3));
}

TEST_CASE("prepare, destroy: memory of the caller is required for its engines, and not released") {
  const Fixture f;
  test::Engine engine(f.config);
  starfocus_prepared* prepared = reinterpret_cast<starfocus_prepared*>(&engine);
  CHECK(starfocus_prepare(engine.get(), &f.field, nullptr, 0, &prepared) == STARFOCUS_ERROR_NULL);
  CHECK(std::string(starfocus_engine_problem(engine.get())->field) == "memory");
  CHECK(prepared == nullptr);
  test::PreparedMemory memory(engine);
  prepared = memory.Prepare(engine.get(), f.field);
  starfocus_destroy_prepared(prepared);
  starfocus_destroy_prepared(nullptr);
  f.CheckPicture(engine.get(), prepared);
  starfocus_destroy(nullptr);
  starfocus_destroy(engine.get());
  f.CheckPicture(engine.get());
}

}  // namespace
}  // namespace memory_test
