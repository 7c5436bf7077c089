// SPDX-License-Identifier: Apache-2.0
// The pool of starfocus/pool.h as programs see it. How its threads sleep and wake, runner_test has.
#include "starfocus/pool.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "tests/support/test_scene.h"
#include "tests/support/watch.h"

namespace pool_test {
namespace {

struct Record {
  explicit Record(int count) : calls(size_t(count)) {}

  std::vector<std::atomic<int>> calls;  // of each index
  std::atomic<int> busy[SF_MAX_WORKERS] = {};
  std::atomic<int> clashes{0}, outside{0};
  int workers = SF_MAX_WORKERS;

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

void CheckRuns(sf_pool* pool, int count) {
  Record record(count);
  record.workers = sf_pool_workers(pool);
  REQUIRE(sf_pool_run(pool, Record::Job, &record, count) == 0);
  bool once = true;
  for (const std::atomic<int>& calls : record.calls) once = once && calls == 1;
  CHECK(once);
  CHECK(record.clashes == 0);
  CHECK(record.outside == 0);
}

TEST_CASE("pool: every job once, by workers of its own, set after set") {
  for (const int workers : {1, 2, 5, SF_MAX_WORKERS}) {
    sf_pool* const pool = sf_pool_create(workers);
    REQUIRE(pool != nullptr);
    CHECK(sf_pool_workers(pool) == workers);
    for (int repeat = 0; repeat < 10; ++repeat) {
      for (const int count : {0, 1, 2, 3, 200}) CheckRuns(pool, count);
    }
    sf_pool_destroy(pool);
  }
}

TEST_CASE(
    "pool: 0 workers are as many as there are cores for it, more than the most are the most") {
  CHECK(sf_pool_cores() >= 1);
  CHECK(sf_pool_cores() <= SF_MAX_WORKERS);
  for (const int workers : {0, -1, INT32_MIN}) {
    sf_pool* const pool = sf_pool_create(workers);
    CHECK(sf_pool_workers(pool) == sf_pool_cores());
    CheckRuns(pool, 100);
    sf_pool_destroy(pool);
  }
  sf_pool* const pool = sf_pool_create(INT32_MAX);
  CHECK(sf_pool_workers(pool) == SF_MAX_WORKERS);
  sf_pool_destroy(pool);
}

TEST_CASE("pool: nonsense is refused") {
  sf_pool* const pool = sf_pool_create(2);
  Record record(1);
  CHECK(sf_pool_run(nullptr, Record::Job, &record, 1) != 0);
  CHECK(sf_pool_run(pool, nullptr, &record, 1) != 0);
  CHECK(sf_pool_run(pool, Record::Job, &record, -1) != 0);
  CHECK(record.calls[0] == 0);
  CHECK(sf_pool_workers(nullptr) == 0);
  sf_pool_destroy(pool);
  sf_pool_destroy(nullptr);
}

TEST_CASE("pool: several live at once, and one serves several callers in turn") {
  sf_pool* const a = sf_pool_create(3);
  sf_pool* const b = sf_pool_create(2);
  Record both(100);
  std::vector<std::thread> callers;
  for (sf_pool* const pool : {a, a, b}) {
    callers.emplace_back([pool] {
      for (int repeat = 0; repeat < 20; ++repeat) CheckRuns(pool, 50);
    });
  }
  for (std::thread& caller : callers) caller.join();
  sf_pool_destroy(a);
  sf_pool_destroy(b);
}

TEST_CASE("pool: an engine's runner, whose progress is told by one thread at a time") {
  const test::Scene scene = test::RandomScene(300, 120, 5, -3, 6, 4);
  sf_config config = test::ConfigFor(scene, 12);
  config.superblock = 32;
  sf_params params = test::Params(-3, 1, SF_MODE_BLOCK);
  test::Output expected(300, 120);
  test::Engine one(config);
  REQUIRE(test::Refocus(&one, params, scene, &expected) == SF_OK);

  sf_pool* const pool = sf_pool_create(4);
  config.max_workers = sf_pool_workers(pool);
  test::Engine engine(config);
  for (const int stop : {test::Watch::kNever, 20, 0, 5, test::Watch::kNever}) {
    CAPTURE(stop);
    test::Watch watch(stop);
    sf_callbacks callbacks = test::ToldTo(test::Watch::Progress, &watch);
    callbacks.runner = sf_pool_run;
    callbacks.runner_data = pool;
    test::Output out(300, 120);
    const sf_status status = test::Refocus(&engine, params, scene, &out, callbacks);
    CHECK(watch.Good());
    CHECK(status == (stop == test::Watch::kNever ? SF_OK : SF_ERROR_CANCELLED));
    if (status != SF_OK) continue;
    CHECK(watch.Ended());
    CHECK(out.bytes == expected.bytes);
  }
  sf_pool_destroy(pool);
}

}  // namespace
}  // namespace pool_test
