// SPDX-License-Identifier: Apache-2.0
// Tests how long the engine uses the functions that starfocus_set_callbacks sets, what the progress
// function may rely on, and runners that break their contract. Calls with such a runner must return
// STARFOCUS_ERROR_RUNNER, and the engine must remain usable.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/scenes.h"
#include "tests/support/test_scene.h"

namespace callbacks_test {
namespace {

constexpr int kWidth = 130, kHeight = 75, kWorkers = 2;

// Counts the calls of each callback.
struct Calls {
  int runner = 0, progress = 0, blocks = 0;
  starfocus_observer observer = {};

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    ++static_cast<Calls*>(self)->runner;
    for (int32_t i = 0; i < count; ++i) job(data, i, 0);
    return 0;
  }
  static int Tell(void* self, int32_t, int32_t) {
    ++static_cast<Calls*>(self)->progress;
    return 0;
  }
  static void Visit(void* self, const starfocus_block*) { ++static_cast<Calls*>(self)->blocks; }

  starfocus_callbacks All() {
    observer = {sizeof observer, [](void*) { return uint64_t{0}; }, nullptr, Visit, this};
    return {Run, this, Tell, this, &observer};
  }
  // Returns true if all callbacks were called, and resets the numbers of calls.
  bool Take() {
    const bool all = runner > 0 && progress > 0 && blocks > 0;
    *this = Calls();
    return all;
  }
  bool None() const { return runner == 0 && progress == 0 && blocks == 0; }
};

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 6, 4);
  test::Config config = MakeConfig();
  test::Engine engine{config};
  starfocus::Params params = test::Params(-9, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight}, expected = test::OutputOf(config, params, scene);
  Calls calls;

  test::Config MakeConfig() const {
    test::Config made = test::ConfigFor(scene, 20);
    made.superblock = 32;
    made.max_workers = kWorkers;
    made.features |= STARFOCUS_FEATURE_STREAMING;
    made.previews = 1;
    made.tuning.gather = 0;
    return made;
  }
  void Set(const starfocus_callbacks& callbacks) {
    REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  }
  // Refocuses with the callbacks that are set.
  starfocus_status Refocus() {
    return test::RefocusRgb(engine.get(), &params, &field, out.bytes.data(), out.stride, nullptr);
  }
  // Refocuses with a runner.
  starfocus_status RunBy(starfocus_runner runner, void* data = nullptr) {
    return test::Refocus(&engine, params, scene, &out, runner, data);
  }
  // Checks that the next call without callbacks returns the right picture.
  void CheckUsable() {
    out = test::Output(kWidth, kHeight);
    CHECK(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
    CHECK(out.bytes == expected.bytes);
  }
};

TEST_CASE("callbacks: the engine calls the set functions until other functions are set") {
  Fixture f;
  starfocus_callbacks callbacks = f.calls.All();
  f.Set(callbacks);
  callbacks = {};  // the engine keeps a copy of the callbacks
  for (int round = 0; round < 2; ++round) {
    REQUIRE(f.Refocus() == STARFOCUS_OK);
    CHECK(f.calls.Take());
  }
  test::PreparedMemory memory(f.engine);
  const starfocus_prepared* prepared = memory.Prepare(f.engine.get(), f.field);
  CHECK(f.calls.runner > 0);
  CHECK(f.calls.progress > 0);
  for (const int shift : {0, 1}) {
    f.calls = Calls{0, 0, 0, f.calls.observer};
    REQUIRE(test::PreviewRgb(f.engine.get(), &f.params, prepared, shift, f.out.bytes.data(),
                             f.out.stride, nullptr) == STARFOCUS_OK);
    CHECK(f.calls.Take());
  }
  f.Set(callbacks);
  REQUIRE(f.Refocus() == STARFOCUS_OK);
  CHECK(f.calls.None());
}

TEST_CASE("callbacks: wrong pointers are rejected, and the previous functions remain in use") {
  Fixture f;
  const starfocus_callbacks callbacks = f.calls.All();
  CHECK(starfocus_set_callbacks(nullptr, &callbacks) == STARFOCUS_ERROR_NULL);
  f.Set(callbacks);
  CHECK(starfocus_set_callbacks(f.engine.get(), nullptr) == STARFOCUS_ERROR_NULL);
  const starfocus_observer not_initialized = {};
  const starfocus_callbacks wrong = {nullptr, nullptr, nullptr, nullptr, &not_initialized};
  CHECK(starfocus_set_callbacks(f.engine.get(), &wrong) == STARFOCUS_ERROR_STRUCTURE);
  REQUIRE(f.Refocus() == STARFOCUS_OK);
  CHECK(f.calls.Take());
}

TEST_CASE("callbacks: the functions of a stream may change between two pulls") {
  Fixture f;
  REQUIRE(starfocus_stream_begin(f.engine.get(), &f.params) == STARFOCUS_OK);
  test::StreamSteps steps = {&f.engine, f.scene, &f.out};
  for (int round = 0; !steps.Ended(); ++round) {
    f.Set(round % 2 == 0 ? f.calls.All() : starfocus_callbacks());
    REQUIRE(steps.Step() == STARFOCUS_OK);
    CHECK(f.calls.None() == (round % 2 != 0));
    f.calls = Calls();
  }
  CHECK(f.out.bytes == f.expected.bytes);
}

// Copies the finished rows of a picture whenever the progress callback runs.
struct FinishedRows {
  const test::Output* out;
  std::vector<std::vector<uint8_t>> copies;

  static int Copy(void* data, int32_t rows_done, int32_t) {
    FinishedRows* self = static_cast<FinishedRows*>(data);
    const auto begin = self->out->bytes.begin();
    const auto size = ptrdiff_t(self->out->stride) * rows_done;
    if (self->copies.empty() || self->copies.back().size() < size_t(size)) {
      self->copies.emplace_back(begin, begin + size);
    }
    return 0;
  }
};

TEST_CASE("callbacks: rows that are reported as finished are complete and do not change") {
  constexpr int kSide = 32;
  test::Scene scene = test::LayeredScene(100, 170, 5, 12, 5);
  // Blocks of different layers are adjacent, so that rows above a superblock are deblocked late.
  test::SetDisparity(&scene,
                     [](int x, int y) { return (x / kSide + y / kSide) % 2 == 0 ? 0.0f : 11.0f; });
  test::Config config = test::ConfigFor(scene, 13);
  config.superblock = kSide;
  config.max_workers = 2;
  config.tuning.deblocking = 255;
  test::Engine engine(config);
  for (const starfocus_region region : {starfocus_region{0, 0, 0, 0}, {5, 21, 70, 120}}) {
    starfocus::Params params = test::Params(-1, 1, STARFOCUS_MODE_BLOCK);
    params.region = region;
    test::Output out(region.width > 0 ? region.width : 100, region.width > 0 ? region.height : 170);
    FinishedRows rows = {&out, {}};
    starfocus_callbacks callbacks = {};
    callbacks.runner = test::RunOnTwo;
    callbacks.progress = FinishedRows::Copy;
    callbacks.progress_data = &rows;
    REQUIRE(test::Refocus(&engine, params, scene, &out, callbacks, nullptr) == STARFOCUS_OK);
    REQUIRE(rows.copies.size() > 3);
    for (const std::vector<uint8_t>& copy : rows.copies) {
      CHECK(std::equal(copy.begin(), copy.end(), out.bytes.begin()));
    }
  }
}

// Arguments that the engine passes to a runner: one set of jobs.
struct Set {
  void Some(int32_t first, int32_t end) const {
    for (int32_t i = first; i < end; ++i) job(data, i, i % kWorkers);
  }
  void All() const { Some(0, count); }
  void AllAnd(int32_t index, int32_t worker) const {
    All();
    job(data, index, worker);
  }
  void AllBy(int32_t worker) const {
    for (int32_t i = 0; i < count; ++i) job(data, i, worker);
  }

  starfocus_job job;
  void* data;
  int32_t count;
};

struct Misuse {
  std::string what;
  void (*run)(const Set&);
};

// Runners that break the contract but return success.
const Misuse kMisuses[] = {
    {"runs nothing", [](const Set&) {}},
    {"skips the first job", [](const Set& s) { s.Some(1, s.count); }},
    {"skips the last job", [](const Set& s) { s.Some(0, s.count - 1); }},
    {"runs a job twice", [](const Set& s) { s.AllAnd(s.count - 1, 1); }},
    {"runs the first job more often than there are jobs",
     [](const Set& s) {
       for (int32_t i = 0; i <= s.count; ++i) s.job(s.data, 0, 0);
     }},
    {"index -1", [](const Set& s) { s.AllAnd(-1, 0); }},
    {"index count", [](const Set& s) { s.AllAnd(s.count, 0); }},
    {"smallest index", [](const Set& s) { s.AllAnd(INT32_MIN, 0); }},
    {"largest index", [](const Set& s) { s.AllAnd(INT32_MAX, 0); }},
    {"worker -1", [](const Set& s) { s.AllBy(-1); }},
    {"worker max_workers", [](const Set& s) { s.AllBy(kWorkers); }},
    {"runs an additional job with a wrong worker",
     [](const Set& s) { s.AllAnd(0, STARFOCUS_MAX_WORKERS); }},
    {"smallest worker", [](const Set& s) { s.job(s.data, 0, INT32_MIN); }},
    {"largest worker", [](const Set& s) { s.job(s.data, 0, INT32_MAX); }},
};

// Runner that breaks the contract for one of the sets of jobs.
struct Runner {
  void (*misuse)(const Set&);
  int misused_set;
  int sets = 0;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    Runner& runner = *static_cast<Runner*>(self);
    const Set set = {job, data, count};
    runner.sets++ == runner.misused_set ? runner.misuse(set) : set.All();
    return 0;
  }
};

TEST_CASE("runner: misuse of any set of jobs is an error and does not affect later calls") {
  Fixture f;
  Runner good = {nullptr, -1};
  REQUIRE(f.RunBy(Runner::Run, &good) == STARFOCUS_OK);
  CHECK(f.out.bytes == f.expected.bytes);
  CHECK(good.sets > 6);
  for (const Misuse& misuse : kMisuses) {
    CAPTURE(misuse.what);
    for (int set = 0; set < good.sets; set += set < 6 ? 1 : 5) {
      CAPTURE(set);
      Runner bad = {misuse.run, set};
      CHECK(f.RunBy(Runner::Run, &bad) == STARFOCUS_ERROR_RUNNER);
      CHECK(bad.sets == set + 1);
      const starfocus_problem* const problem = starfocus_engine_problem(f.engine.get());
      CHECK(problem->status == STARFOCUS_ERROR_RUNNER);
      CHECK(std::string(problem->field) == "runner");
    }
    f.CheckUsable();
  }
}

// The set of jobs that a runner has received most recently.
Set running;
bool nested = false;

TEST_CASE("runner: a job for a worker that is busy is rejected with STARFOCUS_ERROR_RUNNER") {
  Fixture f;
  nested = false;
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  // Jobs call the clock, which starts another job while the first job runs. The nested call
  // simulates another thread that uses worker 0 at the same time.
  observer.clock = [](void*) -> uint64_t {
    if (!nested) running.job(running.data, 2, 0);
    nested = true;
    return 0;
  };
  starfocus_callbacks callbacks = test::ObservedBy(&observer);
  callbacks.runner = [](void*, starfocus_job job, void* data, int32_t count) {
    running = {job, data, count};
    running.AllBy(0);
    return 0;
  };
  CHECK(test::Refocus(&f.engine, f.params, f.scene, &f.out, callbacks) == STARFOCUS_ERROR_RUNNER);
  CHECK(nested);
}

TEST_CASE("runner: a job called after its runner has returned does nothing") {
  Fixture f;
  const starfocus_runner keeps = [](void*, starfocus_job job, void* data, int32_t count) {
    running = {job, data, count};
    running.All();
    return 0;
  };
  REQUIRE(f.RunBy(keeps) == STARFOCUS_OK);
  for (const int worker : {-1, 0, 1, kWorkers, STARFOCUS_MAX_WORKERS}) {
    for (const int index : {-1, 0, 1, 1000}) running.job(running.data, index, worker);
  }
  CHECK(f.out.bytes == f.expected.bytes);
  // Jobs that a runner starts too late must not affect the next refocusing.
  CHECK(f.RunBy(keeps) == STARFOCUS_OK);
  CHECK(f.out.bytes == f.expected.bytes);
}

TEST_CASE("runner: the engine waits for jobs that still run when their runner returns") {
  Fixture f;
  // The runner omits the last job, so that no set is complete, however fast the thread is.
  const starfocus_runner leaves = [](void* data_of_runner, starfocus_job job, void* data,
                                     int32_t count) {
    std::thread& thread = *static_cast<std::thread*>(data_of_runner);
    if (thread.joinable()) thread.join();
    std::atomic<bool> started{false};
    thread = std::thread([&started, job, data, count] {
      started = true;
      for (int32_t i = 0; i < 100 * count; ++i) job(data, count > 1 ? i % (count - 1) : 0, 1);
    });
    while (!started) std::this_thread::yield();
    return 0;
  };
  for (int round = 0; round < 50; ++round) {
    std::thread thread;
    CHECK(f.RunBy(leaves, &thread) == STARFOCUS_ERROR_RUNNER);
    const std::vector<uint8_t> left = f.out.bytes;
    thread.join();
    CHECK(f.out.bytes == left);
  }
  f.CheckUsable();
}

}  // namespace
}  // namespace callbacks_test
