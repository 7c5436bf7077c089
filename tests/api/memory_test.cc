// SPDX-License-Identifier: Apache-2.0
// Tests where the memory of the library comes from. The results of starfocus_create and
// starfocus_prepare are one piece of memory each from the allocator, which is released later. All
// other calls allocate nothing on the heap: this program replaces malloc and related functions, and
// counts their calls while the engine works.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "starfocus/matte.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/images.h"
#include "tests/support/refocused.h"
#include "tests/support/sanitizers.h"
#include "tests/support/test_scene.h"

#if defined(__GLIBC__) && !defined(STARFOCUS_SANITIZED)

namespace {

std::atomic<bool> armed{false};
std::atomic<int> calls{0};

void Count() {
  if (armed.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}

// Counts the heap calls from construction to Stop or destruction.
class HeapWatch {
 public:
  HeapWatch() {
    calls = 0;
    armed = true;
  }
  ~HeapWatch() { armed = false; }
  int Stop() {
    armed = false;
    return calls;
  }
};

}  // namespace

// The forms of new and delete call the following functions.
extern "C" {

void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

void* malloc(size_t size) noexcept {
  Count();
  return __libc_malloc(size);
}
void* calloc(size_t count, size_t size) noexcept {
  Count();
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) noexcept {
  Count();
  return __libc_realloc(memory, size);
}
void* memalign(size_t alignment, size_t size) noexcept {
  Count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept {
  Count();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) noexcept {
  Count();
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}
void free(void* memory) noexcept {
  Count();
  __libc_free(memory);
}

}  // extern "C"

#endif

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

#if defined(__GLIBC__) && !defined(STARFOCUS_SANITIZED)

TEST_CASE("heap: HeapWatch counts every kind of heap call") {
  HeapWatch watch;
  void* volatile memory = std::malloc(10);
  memory = std::realloc(memory, 1000);
  std::free(memory);
  memory = std::calloc(3, 5);
  std::free(memory);
  int* volatile number = new int(3);
  delete number;
  void* volatile aligned = ::operator new(64, std::align_val_t(64), std::nothrow);
  ::operator delete(aligned, std::align_val_t(64));
  CHECK(watch.Stop() >= 9);
}

// Checks that `calls` makes no heap call. `calls` returns the number of engine calls with an
// unexpected status, because CHECK may allocate memory.
template <class Calls>
void CheckNoHeapCall(const Calls& calls) {
  HeapWatch watch;
  const int wrong = calls();
  const int counted = watch.Stop();
  CHECK(wrong == 0);
  CHECK(counted == 0);
}

// Statuses of calls; counts the unexpected ones.
struct Statuses {
  void Are(starfocus_status expected, std::initializer_list<starfocus_status> found) {
    for (const starfocus_status status : found) wrong += status != expected;
  }
  int wrong = 0;
};

TEST_CASE("heap: an engine, its streams, regions, previews and observers make no heap call") {
  for (const int views : test::kStars) {
    for (const starfocus_mode mode : test::kModes) {
      CAPTURES(views, mode);
      // The left part of the scene is in focus, and the right part is strongly blurred.
      test::Scene scene = test::RandomScene(160, 96, views, -1, 26, 8);
      test::SetDisparity(&scene, [](int x, int) { return x < 48 ? 0.0f : x < 80 ? 6.0f : 26.0f; });
      test::Config config = test::ConfigFor(scene, 28);
      config.superblock = 32;
      config.features |= STARFOCUS_FEATURE_STREAMING;
      config.tuning.gather = 0;  // without gathering, blocks use all layers
      config.previews = 1;
      test::Engine holder(config);  // the test uses the memory of this engine, and its stream
      REQUIRE(holder.status() == STARFOCUS_OK);
      test::PreparedMemory prepared_memory(holder);
      const starfocus_allocator allocator = {holder.workspace(),
                                             [](void* memory, size_t, size_t) { return memory; },
                                             [](void*, void*, size_t) {}};
      const starfocus::Params params = test::Params(0, 1, mode);
      starfocus::Params region = params;
      region.region = {30, 20, 50, 50};
      const starfocus_light_field field = scene.Field();
      test::Output out(160, 96);
      uint8_t* const at = out.bytes.data();
      int blocks = 0, left = 30;
      starfocus_observer observer = test::Visitor(
          [](void* data, const starfocus_block*) { ++*static_cast<int*>(data); }, &blocks);
      observer.clock = [](void*) -> uint64_t { return 7; };
      starfocus_callbacks callbacks = test::ObservedBy(&observer);
      callbacks.runner = [](void*, starfocus_job job, void* data, int32_t count) {
        for (int32_t i = count - 1; i >= 0; --i) job(data, i, 0);
        return 0;
      };
      const starfocus_callbacks cancels = test::ToldTo(
          [](void* data, int32_t, int32_t) { return --*static_cast<int*>(data) <= 0 ? 1 : 0; },
          &left);
      test::Report report;
      CheckNoHeapCall([&] {
        Statuses statuses;
        size_t bytes = 0;
        starfocus_engine* engine = nullptr;
        starfocus_prepared* prepared = nullptr;
        statuses.Are(STARFOCUS_OK,
                     {starfocus_workspace_size(&config, &bytes, nullptr),
                      starfocus_init(&config, holder.workspace(), bytes, &engine, nullptr),
                      starfocus_set_callbacks(engine, &callbacks),
                      test::RefocusRgb(engine, &params, &field, at, out.stride, &report),
                      test::RefocusRgb(engine, &region, &field, at, out.stride, nullptr),
                      starfocus_prepare(engine, &field, prepared_memory.get(),
                                        prepared_memory.bytes, &prepared),
                      test::RefocusPreparedRgb(engine, &region, prepared, at, out.stride, nullptr),
                      test::PreviewRgb(engine, &params, prepared, 1, at, out.stride, nullptr),
                      test::Stream(&holder, params, scene, &out, 13, 7)});
        statuses.Are(STARFOCUS_ERROR_NULL,
                     {test::RefocusRgb(engine, &params, &field, nullptr, 0, nullptr)});
        starfocus_status_string(STARFOCUS_ERROR_NULL);
        starfocus_simd_target();
        statuses.Are(STARFOCUS_OK, {starfocus_create(&config, &allocator, &engine, nullptr),
                                    starfocus_set_callbacks(engine, &cancels)});
        statuses.Are(STARFOCUS_ERROR_CANCELLED,
                     {test::RefocusRgb(engine, &params, &field, at, out.stride, nullptr)});
        starfocus_destroy(engine);
        return statuses.wrong;
      });
      CHECK(left == 0);
      CHECK(blocks > 0);
      if (mode != STARFOCUS_MODE_BLOCK) continue;
      for (const starfocus_layer_report& layer : report.layers) CHECK(layer.blocks > 0);
    }
  }
}

TEST_CASE("heap: refocusing and streaming images make no heap call") {
  test::Random random(3);
  const test::Scene scene = test::RandomScene(70, 50, 5, -3, 3, 5);
  test::ImageKind nv12;
  nv12.format = STARFOCUS_FORMAT_NV12;
  const test::ImageField field = test::MakeImageField(
      scene, {nv12},
      test::MakeDepth(scene, 35, 25, STARFOCUS_DEPTH_U16, STARFOCUS_DEPTH_RECIPROCAL, 0), &random);
  test::Config config = test::ImageConfig(field, 16);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  test::ImageMemory image(70, 50, nv12);
  const starfocus_light_field images = field.Field();
  const starfocus_image out = image.Out();
  const starfocus::Params params = test::Params(1.25, 0.9, STARFOCUS_MODE_BLOCK);
  int32_t taken = 0, given = 0;
  CheckNoHeapCall([&] {
    Statuses statuses;
    statuses.Are(STARFOCUS_OK, {starfocus_refocus(engine.get(), &params, &images, &out, nullptr),
                                starfocus_stream_begin(engine.get(), &params),
                                starfocus_stream_push(engine.get(), &images, 50, &taken),
                                starfocus_stream_pull(engine.get(), &out, 50, &given, nullptr)});
    return statuses.wrong;
  });
  CHECK(given == 50);
}

TEST_CASE("heap: maps, focus at a pixel, and coverage from mattes make no heap call") {
  test::Scene scene = test::RandomScene(40, 30, 1, -30, 30, 6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int x = 0; x < 40; ++x) scene.Disparity(x, 11) = nan;
  scene.Disparity(4, 4) = nan;
  const starfocus_depth_map depth = starfocus_depth_float(scene.disparity.data(), 160, 40, 30);
  const std::vector<uint8_t> alpha(90 * 20, 200);
  const starfocus_matte matte = {alpha.data(), 90, 1, 90, 20};
  const starfocus_matte_depth surfaces = {20, 0, 0.4, 0.9};
  std::vector<float> disparity(40 * 30);
  std::vector<uint8_t> coverage(40 * 30);
  starfocus_disparity_output out = {};
  out.disparity = disparity.data();
  out.disparity_stride = 160;
  out.coverage = coverage.data();
  out.coverage_stride = 40;
  starfocus_disparity_stats stats;
  CheckNoHeapCall([&] {
    Statuses statuses;
    starfocus_matte_stats matte_stats;
    double focus = 0;
    statuses.Are(STARFOCUS_OK,
                 {starfocus_measure_disparity(&depth, &stats, nullptr),
                  starfocus_fill_disparity(scene.disparity.data(), 160, 40, 30, nullptr),
                  starfocus_focus_at(&depth, 40, 30, 4, 4, &focus, nullptr),
                  starfocus_measure_matte(&matte, &matte_stats, nullptr),
                  starfocus_matte_field(&matte, &surfaces, 40, 30, nullptr, &out, nullptr),
                  starfocus_matte_coverage(&matte, &depth, 40, 30, nullptr, &out, nullptr)});
    return statuses.wrong;
  });
  CHECK(stats.invalid == 41);
}

#else

TEST_CASE("heap: calls cannot be counted in this build") {
  MESSAGE("SKIPPED: malloc cannot be interposed here (not glibc, or a sanitizer)");
}

#endif

}  // namespace
}  // namespace memory_test
