// SPDX-License-Identifier: Apache-2.0
// Runners that break their contract: STARFOCUS_ERROR_RUNNER, and nothing worse.
#include <doctest/doctest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/test_scene.h"

namespace runner_misuse_test {
namespace {

constexpr int kWidth = 130, kHeight = 70, kWorkers = 2;

// A runner's way to run one set of jobs; it always says success.
using RunSet = void (*)(starfocus_job job, void* data, int32_t count);

void RunAll(starfocus_job job, void* data, int32_t count) {
  for (int32_t i = 0; i < count; ++i) job(data, i, i % kWorkers);
}

struct Misuse {
  std::string what;
  RunSet run;
};

const Misuse kMisuses[] = {
    {"runs nothing", [](starfocus_job, void*, int32_t) {}},
    {"skips the first job",
     [](starfocus_job job, void* data, int32_t count) {
       for (int32_t i = 1; i < count; ++i) job(data, i, 0);
     }},
    {"skips the last job",
     [](starfocus_job job, void* data, int32_t count) {
       for (int32_t i = 0; i < count - 1; ++i) job(data, i, 0);
     }},
    {"runs a job twice",
     [](starfocus_job job, void* data, int32_t count) {
       RunAll(job, data, count);
       job(data, count - 1, 1);
     }},
    {"runs one job as often as there are jobs",
     [](starfocus_job job, void* data, int32_t count) {
       for (int32_t i = 0; i <= count; ++i) job(data, 0, 0);
     }},
    {"index -1",
     [](starfocus_job job, void* data, int32_t count) {
       job(data, -1, 0);
       RunAll(job, data, count);
     }},
    {"index count",
     [](starfocus_job job, void* data, int32_t count) {
       RunAll(job, data, count);
       job(data, count, 0);
     }},
    {"least index",
     [](starfocus_job job, void* data, int32_t count) {
       RunAll(job, data, count);
       job(data, INT32_MIN, 0);
     }},
    {"largest index",
     [](starfocus_job job, void* data, int32_t count) {
       RunAll(job, data, count);
       job(data, INT32_MAX, 0);
     }},
    {"worker -1",
     [](starfocus_job job, void* data, int32_t count) {
       for (int32_t i = 0; i < count; ++i) job(data, i, -1);
     }},
    {"worker max_workers",
     [](starfocus_job job, void* data, int32_t count) {
       for (int32_t i = 0; i < count; ++i) job(data, i, i % (kWorkers + 1));
       job(data, 0, kWorkers);
     }},
    {"a wrong worker although all is done",
     [](starfocus_job job, void* data, int32_t count) {
       RunAll(job, data, count);
       job(data, 0, STARFOCUS_MAX_WORKERS);
     }},
    {"least worker", [](starfocus_job job, void* data, int32_t) { job(data, 0, INT32_MIN); }},
    {"largest worker", [](starfocus_job job, void* data, int32_t) { job(data, 0, INT32_MAX); }},
};

// Misuses chosen sets.
struct Runner {
  RunSet misuse;
  int misused_set;
  int sets = 0;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    Runner& runner = *static_cast<Runner*>(self);
    (runner.sets++ == runner.misused_set ? runner.misuse : RunAll)(job, data, count);
    return 0;
  }
};

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 6, 4);
  starfocus_config config = test::ConfigFor(scene, 20);
  starfocus_params params = test::Params(-9, 1, STARFOCUS_MODE_BLOCK);
  test::Output expected{kWidth, kHeight};

  Fixture() {
    config.max_workers = kWorkers;
    config.superblock = 32;
    config.tuning.gather = 0;
    test::Engine engine(config);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == STARFOCUS_OK);
  }
};

TEST_CASE("runner: every misuse of every set is an error, and harms no later call") {
  Fixture f;
  test::Engine engine(f.config);
  Runner good = {RunAll, -1};
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

TEST_CASE("runner: starfocus_prepare refuses a runner that skips a job") {
  Fixture f;
  test::Engine engine(f.config);
  test::PreparedMemory memory(f.config);
  const starfocus_light_field field = f.scene.Field();
  Runner bad = {kMisuses[2].run, 1};
  starfocus_prepared* prepared = reinterpret_cast<starfocus_prepared*>(memory.get());
  const starfocus_callbacks callbacks = test::RunBy(Runner::Run, &bad);
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(starfocus_prepare(engine.get(), &field, memory.get(), memory.bytes, &prepared) ==
        STARFOCUS_ERROR_RUNNER);
  CHECK(prepared == nullptr);
  CHECK(std::string(starfocus_engine_problem(engine.get())->field) == "runner");
}

// The set that is running, for a clock that is asked within its jobs.
struct {
  starfocus_job job;
  void* data;
  bool nested;
} running;

TEST_CASE("runner: a worker that is busy gets no second job") {
  Fixture f;
  test::Engine engine(f.config);
  test::Output out(kWidth, kHeight);
  running.nested = false;
  starfocus_callbacks callbacks = {};
  callbacks.clock = []() -> uint64_t {
    // As if another thread had the same worker at the same time.
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
    RunAll(job, data, count);
    return 0;
  };
  REQUIRE(test::Refocus(&engine, f.params, f.scene, &out, keeps) == STARFOCUS_OK);
  for (const int worker : {-1, 0, 1, kWorkers, STARFOCUS_MAX_WORKERS}) {
    for (const int index : {-1, 0, 1, 1000}) running.job(running.data, index, worker);
  }
  CHECK(out.bytes == f.expected.bytes);
  // And spoils nothing that comes.
  CHECK(test::Refocus(&engine, f.params, f.scene, &out, keeps) == STARFOCUS_OK);
  CHECK(out.bytes == f.expected.bytes);
}

TEST_CASE("runner: jobs that still run when their runner returns are waited for") {
  Fixture f;
  test::Engine engine(f.config);
  // Leaves the last job out, so that no set is complete, however fast the thread is.
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
