// SPDX-License-Identifier: Apache-2.0
// Tests how the threads of a pool sleep, wake and fail. pool_test checks that each job runs once.
#include "platform/runner.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <initializer_list>
#include <new>
#include <thread>

namespace starfocus::runner_test {
namespace {

// Each worker waits for all other workers, so that the test hangs if a worker does not wake.
struct Meeting {
  int workers;
  std::atomic<int> met{0};

  static void Job(void* data, int32_t, int32_t) {
    auto* self = static_cast<Meeting*>(data);
    ++self->met;
    while (self->met < self->workers) std::this_thread::yield();
  }
};

TEST_CASE("runner: jobs of one batch run at the same time") {
  for (int workers : {2, 3, 64}) {
    ThreadRunner runner(workers);
    Meeting meeting{workers};
    CHECK(ThreadRunner::Run(&runner, Meeting::Job, &meeting, workers) == 0);
    CHECK(meeting.met == workers);
  }
}

TEST_CASE("runner: threads wake for a batch at any time") {
  ThreadRunner runner(3);
  // Batches begin before, while and after the threads fall asleep.
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
  // std::clock() is the processor time of the whole process. Busy threads would use 200 ms on every
  // core.
  CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 0.05);
}

TEST_CASE("runner: the caller gets the first exception of a batch after all jobs have ended") {
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
      // The pool must run the next batch normally.
      Meeting meeting{workers};
      REQUIRE(ThreadRunner::Run(&runner, Meeting::Job, &meeting, workers) == 0);
      CHECK(meeting.met == workers);
    }
  }
}

TEST_CASE("runner: invalid arguments are rejected or clamped") {
  ThreadRunner runner(-5);
  CHECK(runner.workers() == 1);
  Meeting meeting{1};
  CHECK(ThreadRunner::Run(nullptr, Meeting::Job, &meeting, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, nullptr, &meeting, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, Meeting::Job, &meeting, -1) != 0);
  CHECK(meeting.met == 0);
}

}  // namespace
}  // namespace starfocus::runner_test
