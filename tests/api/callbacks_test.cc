// SPDX-License-Identifier: Apache-2.0
// Tests how long the engine uses the functions that starfocus_set_callbacks sets.
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
#include "tests/support/layered_scene.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/refocused.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"

namespace callbacks_test {
namespace {

constexpr int kWidth = 70, kHeight = 75;

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
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 9, 8);
  starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight};
  Calls calls;

  test::Config Config() const {
    test::Config config = test::ConfigFor(scene, 12);
    config.superblock = 32;
    config.features |= STARFOCUS_FEATURE_STREAMING;
    config.previews = 1;
    return config;
  }
  starfocus_status Refocus(test::Engine* engine) {
    return test::RefocusRgb(engine->get(), &params, &field, out.bytes.data(), out.stride, nullptr);
  }
};

TEST_CASE("callbacks: the engine calls the set functions until other functions are set") {
  Fixture f;
  test::Engine engine(f.Config());
  starfocus_callbacks callbacks = f.calls.All();
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  callbacks = {};  // the engine keeps a copy of the callbacks
  for (int round = 0; round < 2; ++round) {
    REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
    CHECK(f.calls.Take());
  }
  test::PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), f.field);
  CHECK(f.calls.runner > 0);
  CHECK(f.calls.progress > 0);
  test::Output preview((kWidth + 1) / 2, (kHeight + 1) / 2);
  REQUIRE(test::PreviewRgb(engine.get(), &f.params, prepared, 1, preview.bytes.data(),
                           preview.stride, nullptr) == STARFOCUS_OK);
  CHECK(f.calls.Take());
  REQUIRE(test::RefocusPreparedRgb(engine.get(), &f.params, prepared, f.out.bytes.data(),
                                   f.out.stride, nullptr) == STARFOCUS_OK);
  CHECK(f.calls.Take());
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
  CHECK(f.calls.None());
}

TEST_CASE("callbacks: wrong pointers are rejected, and the previous functions remain in use") {
  Fixture f;
  test::Engine engine(f.Config());
  const starfocus_callbacks callbacks = f.calls.All();
  CHECK(starfocus_set_callbacks(nullptr, &callbacks) == STARFOCUS_ERROR_NULL);
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(starfocus_set_callbacks(engine.get(), nullptr) == STARFOCUS_ERROR_NULL);
  const starfocus_observer not_initialized = {};
  const starfocus_callbacks wrong = {nullptr, nullptr, nullptr, nullptr, &not_initialized};
  CHECK(starfocus_set_callbacks(engine.get(), &wrong) == STARFOCUS_ERROR_STRUCTURE);
  REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
  CHECK(f.calls.Take());
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

// Runs jobs with even indices as worker 0 and jobs with odd indices as worker 1.
int RunOnTwo(void*, starfocus_job job, void* data, int32_t count) {
  std::thread other([=] {
    for (int32_t i = 1; i < count; i += 2) job(data, i, 1);
  });
  for (int32_t i = 0; i < count; i += 2) job(data, i, 0);
  other.join();
  return 0;
}

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
    callbacks.runner = RunOnTwo;
    callbacks.progress = FinishedRows::Copy;
    callbacks.progress_data = &rows;
    REQUIRE(test::Refocus(&engine, params, scene, &out, callbacks, nullptr) == STARFOCUS_OK);
    REQUIRE(rows.copies.size() > 3);
    for (const std::vector<uint8_t>& copy : rows.copies) {
      CHECK(std::equal(copy.begin(), copy.end(), out.bytes.begin()));
    }
  }
}

TEST_CASE("callbacks: the functions of a stream may change between two pulls") {
  Fixture f;
  test::Engine engine(f.Config());
  const test::Output expected = test::OutputOf(&engine, f.params, f.scene);
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  test::StreamSteps steps = {&engine, f.scene, &f.out};
  for (int round = 0; !steps.Ended(); ++round) {
    const starfocus_callbacks callbacks = round % 2 == 0 ? f.calls.All() : starfocus_callbacks();
    REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
    REQUIRE(steps.Step() == STARFOCUS_OK);
    CHECK(f.calls.None() == (round % 2 != 0));
    f.calls = Calls();
  }
  CHECK(f.out.bytes == expected.bytes);
}

}  // namespace
}  // namespace callbacks_test

// Tests runners that break their contract. Calls with such a runner must return
// STARFOCUS_ERROR_RUNNER, and the engine must remain usable.

namespace runner_misuse_test {
namespace {

constexpr int kWidth = 130, kHeight = 70, kWorkers = 2;

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

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 20);
  starfocus::Params params = test::Params(-9, 1, STARFOCUS_MODE_BLOCK);
  test::Output expected{kWidth, kHeight};

  Fixture() {
    config.max_workers = kWorkers;
    config.superblock = 32;
    config.tuning.gather = 0;
    test::Engine engine(config);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == STARFOCUS_OK);
  }
};

TEST_CASE("runner: misuse of any set of jobs is an error and does not affect later calls") {
  Fixture f;
  test::Engine engine(f.config);
  Runner good = {nullptr, -1};
  test::Output out(kWidth, kHeight);
  REQUIRE(test::Refocus(&engine, f.params, f.scene, &out, Runner::Run, &good) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
  CHECK(good.sets > 6);
  for (const Misuse& misuse : kMisuses) {
    CAPTURE(misuse.what);
    for (int set = 0; set < good.sets; set += set < 6 ? 1 : 5) {
      CAPTURE(set);
      Runner bad = {misuse.run, set};
      CHECK(test::Refocus(&engine, f.params, f.scene, &out, Runner::Run, &bad) ==
            STARFOCUS_ERROR_RUNNER);
      CHECK(bad.sets == set + 1);
      const starfocus_problem* const problem = starfocus_engine_problem(engine.get());
      CHECK(problem->status == STARFOCUS_ERROR_RUNNER);
      CHECK(std::string(problem->field) == "runner");
    }
    out = test::Output(kWidth, kHeight);
    CHECK(test::Refocus(&engine, f.params, f.scene, &out) == STARFOCUS_OK);
    CHECK(out.bytes == f.expected.bytes);
  }
}

// The set of jobs that a runner has received. The clock callback, which jobs call, starts one of
// the stored jobs while another job runs.
struct {
  starfocus_job job;
  void* data;
  bool nested;
} running;

TEST_CASE("runner: a job for a worker that is busy is rejected with STARFOCUS_ERROR_RUNNER") {
  Fixture f;
  test::Engine engine(f.config);
  test::Output out(kWidth, kHeight);
  running.nested = false;
  starfocus_callbacks callbacks = {};
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  callbacks.observer = &observer;
  observer.clock = [](void*) -> uint64_t {
    // The nested call simulates another thread that uses worker 0 at the same time.
    if (!running.nested) running.job(running.data, 2, 0);
    running.nested = true;
    return 0;
  };
  callbacks.runner = [](void*, starfocus_job job, void* data, int32_t count) {
    running.job = job;
    running.data = data;
    for (int32_t i = 0; i < count; ++i) job(data, i, 0);
    return 0;
  };
  CHECK(test::Refocus(&engine, f.params, f.scene, &out, callbacks) == STARFOCUS_ERROR_RUNNER);
  CHECK(running.nested);
}

TEST_CASE("runner: a job called after its runner has returned does nothing") {
  Fixture f;
  test::Engine engine(f.config);
  test::Output out(kWidth, kHeight);
  const starfocus_runner keeps = [](void*, starfocus_job job, void* data, int32_t count) {
    running.job = job;
    running.data = data;
    Set{job, data, count}.All();
    return 0;
  };
  REQUIRE(test::Refocus(&engine, f.params, f.scene, &out, keeps) == STARFOCUS_OK);
  for (const int worker : {-1, 0, 1, kWorkers, STARFOCUS_MAX_WORKERS}) {
    for (const int index : {-1, 0, 1, 1000}) running.job(running.data, index, worker);
  }
  CHECK(out.bytes == f.expected.bytes);
  // Jobs that a runner starts too late must not affect the next refocusing.
  CHECK(test::Refocus(&engine, f.params, f.scene, &out, keeps) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
}

TEST_CASE("runner: the engine waits for jobs that still run when their runner returns") {
  Fixture f;
  test::Engine engine(f.config);
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
    test::Output out(kWidth, kHeight);
    CHECK(test::Refocus(&engine, f.params, f.scene, &out, leaves, &thread) ==
          STARFOCUS_ERROR_RUNNER);
    const std::vector<uint8_t> left = out.bytes;
    thread.join();
    CHECK(out.bytes == left);
  }
  test::Output out(kWidth, kHeight);
  CHECK(test::Refocus(&engine, f.params, f.scene, &out) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
}

}  // namespace
}  // namespace runner_misuse_test
