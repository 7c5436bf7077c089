// SPDX-License-Identifier: Apache-2.0
#include "platform/runner.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <new>
#include <thread>
#include <vector>

namespace starfocus::runner_test {
namespace {

struct Record {
  explicit Record(int count) : calls(size_t(count)) {}

  std::vector<std::atomic<int>> calls;  // of each index
  std::atomic<int> busy[STARFOCUS_MAX_WORKERS] = {};
  std::atomic<int> clashes{0}, worst_worker{0};

  static void Job(void* data, int32_t index, int32_t worker) {
    Record* self = static_cast<Record*>(data);
    if (self->busy[worker].fetch_add(1) != 0) ++self->clashes;
    ++self->calls[size_t(index)];
    int worst = self->worst_worker;
    while (worker > worst && !self->worst_worker.compare_exchange_weak(worst, worker)) {
    }
    if (index % 16 == 0) std::this_thread::yield();
    self->busy[worker].fetch_sub(1);
  }
};

TEST_CASE("runner: every index once, workers in range and never shared") {
  for (int workers : {1, 2, 3, 7, 64}) {
    ThreadRunner runner(workers);
    CHECK(runner.workers() == workers);
    for (int count : {0, 1, 2, 5, 1000}) {
      for (int repeat = 0; repeat < 20; ++repeat) {
        Record record(count);
        REQUIRE(ThreadRunner::Run(&runner, Record::Job, &record, count) == 0);
        bool once = true;
        for (const auto& calls : record.calls) once = once && calls == 1;
        CHECK(once);
        CHECK(record.clashes == 0);
        CHECK(record.worst_worker < workers);
      }
    }
  }
}

// Every worker waits for all the others, so that it hangs where one sleeps on.
struct Meeting {
  int workers;
  std::atomic<int> met{0};

  static void Job(void* data, int32_t, int32_t) {
    auto* self = static_cast<Meeting*>(data);
    ++self->met;
    while (self->met < self->workers) std::this_thread::yield();
  }
};

TEST_CASE("runner: jobs of one batch do run at the same time") {
  for (int workers : {2, 3, 64}) {
    ThreadRunner runner(workers);
    Meeting meeting{workers};
    CHECK(ThreadRunner::Run(&runner, Meeting::Job, &meeting, workers) == 0);
    CHECK(meeting.met == workers);
  }
}

TEST_CASE("runner: threads wake for a batch whenever it comes") {
  ThreadRunner runner(3);
  // Before, while and after they fall asleep.
  for (int pause : {0, 50, 90, 100, 110, 150, 1000}) {
    for (int repeat = 0; repeat < 100; ++repeat) {
      Meeting meeting{3};
      CHECK(ThreadRunner::Run(&runner, Meeting::Job, &meeting, 3) == 0);
      std::this_thread::sleep_for(std::chrono::microseconds(pause));
    }
  }
}

TEST_CASE("runner: the caller waits for the last job, however long it takes") {
  ThreadRunner runner(2);
  struct Slow {
    std::chrono::microseconds time;
    std::atomic<int> met{0}, done{0};
  };
  const auto job = [](void* data, int32_t, int32_t worker) {
    auto* slow = static_cast<Slow*>(data);
    ++slow->met;
    while (slow->met < 2) std::this_thread::yield();
    if (worker != 0) std::this_thread::sleep_for(slow->time);
    ++slow->done;
  };
  for (int time : {0, 50, 90, 100, 110, 150, 1000}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      Slow slow{std::chrono::microseconds(time)};
      CHECK(ThreadRunner::Run(&runner, job, &slow, 2) == 0);
      CHECK(slow.done == 2);
    }
  }
}

TEST_CASE("runner: idle threads sleep") {
  ThreadRunner runner(4);
  Meeting meeting{4};
  REQUIRE(ThreadRunner::Run(&runner, Meeting::Job, &meeting, 4) == 0);
  const std::clock_t start = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  // Of the whole process; awake they would take that time of every core.
  CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 0.05);
}

TEST_CASE("runner: calls from several threads take turns") {
  ThreadRunner runner(4);
  Record record(300);
  std::vector<std::thread> callers;
  for (int i = 0; i < 4; ++i) {
    callers.emplace_back([&] {
      for (int repeat = 0; repeat < 10; ++repeat) {
        ThreadRunner::Run(&runner, Record::Job, &record, 300);
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  bool all = true;
  for (const auto& calls : record.calls) all = all && calls == 40;
  CHECK(all);
  CHECK(record.clashes == 0);
}

TEST_CASE("runner: the first exception of a batch reaches the caller when no job runs any more") {
  struct Batch {
    std::atomic<int> running{0}, calls{0};
    static void Job(void* data, int32_t index, int32_t) {
      Batch* self = static_cast<Batch*>(data);
      ++self->running;
      ++self->calls;
      std::this_thread::sleep_for(std::chrono::milliseconds(index % 3));
      --self->running;
      if (index % 4 == 3) throw std::bad_alloc();
    }
  };
  for (const int workers : {1, 2, 4}) {
    ThreadRunner runner(workers);
    for (int repeat = 0; repeat < 10; ++repeat) {
      Batch batch;
      CHECK_THROWS_AS(ThreadRunner::Run(&runner, Batch::Job, &batch, 100), std::bad_alloc);
      CHECK(batch.running == 0);
      CHECK(batch.calls >= 4);
      CHECK(batch.calls < 100);
      // The pool serves the next batch as if nothing had been.
      Record record(50);
      REQUIRE(ThreadRunner::Run(&runner, Record::Job, &record, 50) == 0);
      for (const std::atomic<int>& calls : record.calls) CHECK(calls == 1);
    }
  }
}

TEST_CASE("runner: nonsense is refused or clamped") {
  ThreadRunner runner(-5);
  CHECK(runner.workers() == 1);
  Record record(1);
  CHECK(ThreadRunner::Run(nullptr, Record::Job, &record, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, nullptr, &record, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, Record::Job, &record, -1) != 0);
  CHECK(record.calls[0] == 0);
}

}  // namespace
}  // namespace starfocus::runner_test
