// SPDX-License-Identifier: Apache-2.0
// Engines of sf_create: memory in one piece of the allocator's, which gets it back.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"

namespace create_test {
namespace {

// Counts, gives memory that holds anything, and checks what it gets back.
struct Counter {
  int allocations = 0, releases = 0, wrong = 0;
  bool empty = false;
  size_t offset = 0;  // from what is aligned
  std::vector<uint8_t> memory;
  void* given = nullptr;
  size_t bytes = 0;

  sf_allocator Allocator() { return {this, Allocate, Release}; }

  static void* Allocate(void* data, size_t bytes, size_t alignment) {
    Counter& self = *static_cast<Counter*>(data);
    ++self.allocations;
    if (alignment != SF_ALIGNMENT) ++self.wrong;
    if (self.empty) return nullptr;
    self.memory.assign(bytes + 2 * alignment, test::kPoison);
    const auto begin = reinterpret_cast<uintptr_t>(self.memory.data());
    const size_t skipped = (alignment - begin % alignment) % alignment + self.offset;
    self.bytes = bytes;
    return self.given = self.memory.data() + skipped;
  }
  static void Release(void* data, void* memory, size_t bytes) {
    Counter& self = *static_cast<Counter*>(data);
    ++self.releases;
    if (memory != self.given || bytes != self.bytes) ++self.wrong;
    self.memory.assign(self.memory.size(), 0xEE);
  }
};

struct Fixture {
  test::Scene scene = test::RandomScene(70, 50, 5, -3, 6, 4);
  sf_config config = test::ConfigFor(scene, 12);
  sf_params params = test::Params(-3, 1, SF_MODE_BLOCK);
  test::Output expected{70, 50};

  Fixture() {
    test::Engine engine(config);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == SF_OK);
  }
  void CheckPicture(sf_engine* engine) const {
    const sf_light_field field = scene.Field();
    test::Output out(70, 50);
    CHECK(test::RefocusRgb(engine, &params, &field, out.bytes.data(), out.stride, nullptr) ==
          SF_OK);
    CHECK(out.bytes == expected.bytes);
  }
};

TEST_CASE("configuration: shorter structures get the defaults of what they lack") {
  constexpr uint32_t kShort = offsetof(sf_config, superblock);
  std::vector<uint8_t> memory(kShort);
  sf_config* const config = reinterpret_cast<sf_config*>(memory.data());
  sf_config_init_sized(config, kShort);
  CHECK(config->size == kShort);
  config->width = config->height = 20;
  sf_config whole;
  sf_config_init(&whole);
  whole.width = whole.height = 20;
  size_t bytes = 0, expected = 0;
  REQUIRE(sf_workspace_size(config, &bytes) == SF_OK);
  REQUIRE(sf_workspace_size(&whole, &expected) == SF_OK);
  CHECK(bytes == expected);
  REQUIRE(sf_prepared_size(config, &bytes) == SF_OK);
  REQUIRE(sf_prepared_size(&whole, &expected) == SF_OK);
  CHECK(bytes == expected);
  sf_engine* engine = nullptr;
  REQUIRE(sf_create(config, nullptr, &engine) == SF_OK);
  sf_destroy(engine);
}

TEST_CASE("configuration: longer structures are zero beyond what the library knows, and refused") {
  std::vector<uint8_t> memory(sizeof(sf_config) + 24, test::kPoison);
  sf_config* const config = reinterpret_cast<sf_config*>(memory.data());
  sf_config_init_sized(config, uint32_t(memory.size()));
  CHECK(config->size == memory.size());
  CHECK(std::count(memory.end() - 24, memory.end(), 0) == 24);
  config->width = config->height = 20;
  size_t bytes = 0;
  CHECK(sf_workspace_size(config, &bytes) == SF_ERROR_STRUCTURE);
}

TEST_CASE("create: one allocation of the workspace's size, given back once") {
  const Fixture f;
  Counter counter;
  size_t bytes = 0;
  REQUIRE(sf_workspace_size(&f.config, &bytes) == SF_OK);
  sf_engine* engine = nullptr;
  {
    // It is copied: the structure itself need not stay.
    const sf_allocator allocator = counter.Allocator();
    REQUIRE(sf_create(&f.config, &allocator, &engine) == SF_OK);
  }
  CHECK(counter.bytes == bytes);
  for (int round = 0; round < 2; ++round) f.CheckPicture(engine);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 0);
  sf_destroy(engine);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 1);
  CHECK(counter.wrong == 0);
}

TEST_CASE("create: without an allocator the heap's memory, aligned") {
  const Fixture f;
  std::vector<sf_engine*> engines(5);
  for (sf_engine*& engine : engines) {
    REQUIRE(sf_create(&f.config, nullptr, &engine) == SF_OK);
    CHECK(reinterpret_cast<uintptr_t>(engine) % SF_ALIGNMENT == 0);
  }
  for (sf_engine* engine : engines) f.CheckPicture(engine);
  for (sf_engine* engine : engines) sf_destroy(engine);
}

TEST_CASE("create: no memory, misaligned memory and other errors leave nothing behind") {
  Fixture f;
  sf_problem problem = {};
  f.config.problem = &problem;
  const auto field = [&problem] { return std::string(problem.field); };
  Counter counter;
  const sf_allocator allocator = counter.Allocator();
  sf_engine* const poison = reinterpret_cast<sf_engine*>(&counter);
  sf_engine* engine = poison;
  counter.empty = true;
  CHECK(sf_create(&f.config, &allocator, &engine) == SF_ERROR_MEMORY);
  CHECK(problem.status == SF_ERROR_MEMORY);
  CHECK(field() == "allocator");
  CHECK(engine == nullptr);
  CHECK(counter.allocations == 1);
  CHECK(counter.releases == 0);

  counter.empty = false;
  counter.offset = 8;
  engine = poison;
  CHECK(sf_create(&f.config, &allocator, &engine) == SF_ERROR_WORKSPACE);
  CHECK(engine == nullptr);
  CHECK(counter.releases == 1);
  CHECK(counter.wrong == 0);

  sf_config bad = f.config;
  bad.views = 3;
  engine = poison;
  CHECK(sf_create(&bad, &allocator, &engine) == SF_ERROR_RANGE);
  CHECK(engine == nullptr);
  CHECK(sf_create(nullptr, &allocator, &engine) == SF_ERROR_NULL);
  CHECK(sf_create(&f.config, &allocator, nullptr) == SF_ERROR_NULL);
  CHECK(field() == "engine");
  const sf_allocator without[] = {{&counter, nullptr, Counter::Release},
                                  {&counter, Counter::Allocate, nullptr}};
  for (const sf_allocator& half : without) {
    CHECK(sf_create(&f.config, &half, &engine) == SF_ERROR_NULL);
    CHECK(field() == (half.allocate == nullptr ? "allocator.allocate" : "allocator.release"));
  }
  CHECK(counter.allocations == 2);
}

TEST_CASE("destroy: null and the caller's own memory are left alone") {
  const Fixture f;
  sf_destroy(nullptr);
  test::Engine engine(f.config);
  REQUIRE(engine.status() == SF_OK);
  sf_destroy(engine.get());
  f.CheckPicture(engine.get());
}

}  // namespace
}  // namespace create_test
