// SPDX-License-Identifier: Apache-2.0
// Tests the pool of starfocus/pool.h through its public interface. runner_test tests how the
// threads of a pool sleep and wake.
#include "starfocus/pool.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"
#include "tests/support/watch.h"

namespace pool_test {
namespace {

struct Record {
  explicit Record(int count) : calls(size_t(count)) {}

  std::vector<std::atomic<int>> calls;  // number of calls of Job for each index
  std::atomic<int> busy[STARFOCUS_MAX_WORKERS] = {};
  std::atomic<int> clashes{0}, outside{0};
  int workers = STARFOCUS_MAX_WORKERS;

  // Returns true if each job was called `times` times, and each worker ran one job at a time.
  bool Good(int times) const {
    const auto called = [=](const std::atomic<int>& count) { return count == times; };
    return std::all_of(calls.begin(), calls.end(), called) && clashes == 0 && outside == 0;
  }
  static void Job(void* data, int32_t index, int32_t worker) {
    Record& self = *static_cast<Record*>(data);
    if (worker < 0 || worker >= self.workers) {
      ++self.outside;
      return;
    }
    if (self.busy[worker].fetch_add(1) != 0) ++self.clashes;
    ++self.calls[size_t(index)];
    if (index % 16 == 0) std::this_thread::yield();
    self.busy[worker].fetch_sub(1);
  }
};

void CheckRuns(starfocus_pool* pool, int count) {
  Record record(count);
  record.workers = starfocus_pool_workers(pool);
  REQUIRE(starfocus_pool_run(pool, Record::Job, &record, count) == 0);
  CHECK(record.Good(1));
}

TEST_CASE("pool: each job runs once, by the workers of the pool, in every batch") {
  for (const int workers : {1, 2, 5, STARFOCUS_MAX_WORKERS}) {
    starfocus_pool* const pool = starfocus_pool_create(workers);
    REQUIRE(pool != nullptr);
    CHECK(starfocus_pool_workers(pool) == workers);
    for (int repeat = 0; repeat < 10; ++repeat) {
      for (const int count : {0, 1, 2, 3, 200, 1000}) CheckRuns(pool, count);
    }
    starfocus_pool_destroy(pool);
  }
}

TEST_CASE(
    "pool: 0 workers select one worker per usable core, and the maximum limits larger numbers") {
  CHECK(starfocus_pool_cores() >= 1);
  CHECK(starfocus_pool_cores() <= STARFOCUS_MAX_WORKERS);
  for (const int workers : {0, -1, INT32_MIN}) {
    starfocus_pool* const pool = starfocus_pool_create(workers);
    CHECK(starfocus_pool_workers(pool) == starfocus_pool_cores());
    CheckRuns(pool, 100);
    starfocus_pool_destroy(pool);
  }
  starfocus_pool* const pool = starfocus_pool_create(INT32_MAX);
  CHECK(starfocus_pool_workers(pool) == STARFOCUS_MAX_WORKERS);
  starfocus_pool_destroy(pool);
}

TEST_CASE("pool: invalid arguments are rejected") {
  starfocus_pool* const pool = starfocus_pool_create(2);
  Record record(1);
  CHECK(starfocus_pool_run(nullptr, Record::Job, &record, 1) != 0);
  CHECK(starfocus_pool_run(pool, nullptr, &record, 1) != 0);
  CHECK(starfocus_pool_run(pool, Record::Job, &record, -1) != 0);
  CHECK(record.calls[0] == 0);
  CHECK(starfocus_pool_workers(nullptr) == 0);
  starfocus_pool_destroy(pool);
  starfocus_pool_destroy(nullptr);
}

TEST_CASE("pool: several pools can exist at once, and one pool can serve several callers in turn") {
  starfocus_pool* const a = starfocus_pool_create(3);
  starfocus_pool* const b = starfocus_pool_create(2);
  Record shared(300);
  std::vector<std::thread> callers;
  for (starfocus_pool* const pool : {a, a, a, b}) {
    callers.emplace_back([&shared, a, pool] {
      for (int repeat = 0; repeat < 20; ++repeat) {
        if (pool == a) {
          starfocus_pool_run(pool, Record::Job, &shared, 300);
        } else {
          CheckRuns(pool, 50);
        }
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  CHECK(shared.Good(60));
  starfocus_pool_destroy(a);
  starfocus_pool_destroy(b);
}

TEST_CASE(
    "pool: a pool can be the runner of an engine, and one thread at a time reports progress") {
  const test::Scene scene = test::RandomScene(300, 120, 5, -3, 6, 4);
  test::Config config = test::ConfigFor(scene, 12);
  config.superblock = 32;
  starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  test::Output expected(300, 120);
  test::Engine one(config);
  REQUIRE(test::Refocus(&one, params, scene, &expected) == STARFOCUS_OK);

  starfocus_pool* const pool = starfocus_pool_create(4);
  config.max_workers = starfocus_pool_workers(pool);
  test::Engine engine(config);
  for (const int stop : {test::Watch::kNever, 20, 0, 5, test::Watch::kNever}) {
    CAPTURE(stop);
    test::Watch watch(stop);
    starfocus_callbacks callbacks = test::ToldTo(test::Watch::Progress, &watch);
    callbacks.runner = starfocus_pool_run;
    callbacks.runner_data = pool;
    test::Output out(300, 120);
    const starfocus_status status = test::Refocus(&engine, params, scene, &out, callbacks);
    CHECK(watch.Good());
    CHECK(status == (stop == test::Watch::kNever ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED));
    if (status != STARFOCUS_OK) continue;
    CHECK(watch.Ended());
    CHECK(out.bytes == expected.bytes);
  }
  starfocus_pool_destroy(pool);
}

}  // namespace
}  // namespace pool_test
