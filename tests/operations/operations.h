// SPDX-License-Identifier: Apache-2.0
// Operations that make pictures or maps, and checks of the properties that each operation must
// have. The bytes of a result must not depend on the workers, on the order of jobs, or on earlier
// results. Calls that were cancelled or whose runner failed must not affect later results.
#ifndef STARFOCUS_TESTS_OPERATIONS_OPERATIONS_H_
#define STARFOCUS_TESTS_OPERATIONS_OPERATIONS_H_

#include <doctest/doctest.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/refocused.h"
#include "tests/support/rounds.h"
#include "tests/support/symmetry.h"
#include "tests/support/test_scene.h"

namespace starfocus::simd {
struct DepthKernels;
struct Kernels;
}  // namespace starfocus::simd

namespace properties {

using Bytes = std::vector<uint8_t>;

// Conditions of an operation that must not affect the bytes of the result.
struct Setup {
  int workers = 1;
  bool used = false;           // True if the engine and its memory were used before.
  int poison = test::kPoison;  // First bytes of the memory; negative: those of the heap.
  double room = 1;             // Factor of test::Config.max_blur.
  bool spare = true;           // True if features are reserved that the operation does not use.
  // Seed of another engine that prepares light fields and then ends; 0: the engine itself.
  uint64_t maker = 0;
  // A null pointer selects the best kernels of this machine.
  const starfocus::simd::Kernels* kernels = nullptr;
  const starfocus::simd::DepthKernels* depth_kernels = nullptr;
  // Symmetry that is applied to the input and undone in the result.
  test::Symmetry mirror = {false, false, false};
};

// Function that executes an operation whose input and engine are set up. A Run may be called any
// number of times.
using Run = std::function<starfocus_status(const starfocus_callbacks& callbacks, Bytes* out)>;

struct Operation {
  std::string name;
  int32_t rows;   // Number of rows that the progress function reports.
  int questions;  // Smallest number of progress calls.
  std::function<Run(const Setup& setup)> set_up;
};

// Executes an operation, which must succeed, and returns the resulting bytes.
inline Bytes Made(const Run& run, const starfocus_callbacks& callbacks = {}) {
  Bytes bytes;
  REQUIRE(run(callbacks, &bytes) == STARFOCUS_OK);
  return bytes;
}

// Returns the indices of `count` jobs in a random order.
inline std::vector<int32_t> Shuffled(int32_t count, test::Random* random) {
  std::vector<int32_t> order(static_cast<size_t>(count));
  for (int32_t i = 0; i < count; ++i) order[size_t(i)] = i;
  for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random->Next() % i]);
  return order;
}

// Runner that starts one thread per worker. The threads run the jobs in a shuffled order.
struct ShuffledRunner {
  int workers, sets = 0, jobs = 0;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    ShuffledRunner* runner = static_cast<ShuffledRunner*>(self);
    runner->jobs += count;
    test::Random random(uint64_t(10 * runner->workers + ++runner->sets));
    const std::vector<int32_t> order = Shuffled(count, &random);
    std::atomic<size_t> next{0};
    std::vector<std::thread> threads;
    for (int32_t worker = 0; worker < runner->workers; ++worker) {
      threads.emplace_back([&, worker] {
        for (size_t i = next++; i < order.size(); i = next++) job(data, order[i], worker);
      });
    }
    for (std::thread& thread : threads) thread.join();
    return 0;
  }
};

inline void CheckWorkers(const Operation& operation) {
  CAPTURE(operation.name);
  const Bytes expected = Made(operation.set_up({}));
  for (const auto& pair : {std::pair(1, 1), {2, 2}, {7, 7}, {3, STARFOCUS_MAX_WORKERS}}) {
    const int workers = pair.first;
    CAPTURE(workers);
    Setup setup;
    setup.workers = pair.second;
    ShuffledRunner runner = {workers};
    const Run run = operation.set_up(setup);
    CHECK((Made(run, test::RunBy(ShuffledRunner::Run, &runner)) == expected));
    CHECK(runner.jobs > 1);
  }
}

// Checks that each setup returns the same bytes as the first setup.
inline void CheckSetups(const Operation& operation, const std::vector<Setup>& setups) {
  CAPTURE(operation.name);
  const Bytes expected = Made(operation.set_up(setups[0]));
  for (size_t k = 1; k < setups.size(); ++k) {
    CAPTURE(k);
    const Run run = operation.set_up(setups[k]);
    for (int round = 0; round < (setups[k].used ? 2 : 1); ++round) {
      CHECK((Made(run) == expected));
    }
  }
}

// Runner that runs only half of the jobs of one set, or of `times` sets. The runner reports only
// every second failure, since the engine must detect missing jobs even if the runner reports
// success.
struct FailingRunner {
  int fails_at, times = 1, sets = 0;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    FailingRunner* runner = static_cast<FailingRunner*>(self);
    const int set = runner->sets++;
    const bool fails = set >= runner->fails_at && set < runner->fails_at + runner->times;
    for (int32_t i = 0; i < (fails ? count / 2 : count); ++i) job(data, i, 0);
    return fails ? runner->fails_at % 2 : 0;
  }
};

// Checks that the call after a failure of the runner returns the whole result, for a failure at
// each set of jobs.
inline void CheckFailingRunner(const Operation& operation) {
  CAPTURE(operation.name);
  const Run run = operation.set_up({});
  const Bytes expected = Made(run);
  for (int at = 0;; ++at) {
    CAPTURE(at);
    FailingRunner runner = {at};
    Bytes bytes;
    const starfocus_status status = run(test::RunBy(FailingRunner::Run, &runner), &bytes);
    if (runner.sets <= at) {
      CHECK(status == STARFOCUS_OK);
      CHECK((bytes == expected));
      CHECK(at > 0);
      return;
    }
    CHECK(status == STARFOCUS_ERROR_RUNNER);
    CHECK(runner.sets == at + 1);
    CHECK((Made(run) == expected));
  }
}

// Cancels an operation at each of its progress calls in turn. In slow builds, the operation is
// cancelled at the first ten calls, and then only at every 17th call. After each cancellation,
// the same engine must return the result of a new engine.
inline void CheckCancelling(const Operation& operation) {
  CAPTURE(operation.name);
  const Bytes expected = Made(operation.set_up({}));
  for (const starfocus_runner runner :
       {starfocus_runner(nullptr), starfocus_runner(test::RunOnTwo)}) {
    CAPTURE(runner == nullptr);
    Setup setup;
    setup.workers = 2;
    const Run run = operation.set_up(setup);
    for (int stop = 0;; stop += test::kSlow && stop >= 10 ? 17 : 1) {
      CAPTURE(stop);
      test::Watch watch(stop);
      starfocus_callbacks callbacks = test::ToldTo(test::Watch::Progress, &watch);
      callbacks.runner = runner;
      Bytes bytes;
      const starfocus_status status = run(callbacks, &bytes);
      CHECK(watch.Good());
      if (watch.calls <= stop) {  // the operation ended before call `stop`
        CHECK(status == STARFOCUS_OK);
        CHECK(watch.Ended());
        CHECK(watch.rows == operation.rows);
        CHECK(watch.calls >= operation.questions);
        CHECK((bytes == expected));
        break;
      }
      REQUIRE(status == STARFOCUS_ERROR_CANCELLED);
      CHECK((Made(run, test::RunBy(runner)) == expected));
    }
  }
}

}  // namespace properties

#endif  // STARFOCUS_TESTS_OPERATIONS_OPERATIONS_H_
