#include "platform/runner.h"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace starfocus {
namespace {

struct Record {
  explicit Record(int count) : calls(size_t(count)) {}

  std::vector<std::atomic<int>> calls;  // of each index
  std::atomic<int> busy[SF_MAX_WORKERS] = {};
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

TEST_CASE("runner: jobs of one batch do run at the same time") {
  ThreadRunner runner(3);
  std::atomic<int> met{0};
  const auto meet = [](void* data, int32_t, int32_t) {
    auto* count = static_cast<std::atomic<int>*>(data);
    ++*count;
    while (*count < 3) std::this_thread::yield();
  };
  CHECK(ThreadRunner::Run(&runner, meet, &met, 3) == 0);
  CHECK(met == 3);
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

TEST_CASE("runner: nonsense is refused or clamped") {
  ThreadRunner runner(-5);
  CHECK(runner.workers() == 1);
  Record record(1);
  CHECK(ThreadRunner::Run(nullptr, Record::Job, &record, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, nullptr, &record, 1) != 0);
  CHECK(ThreadRunner::Run(&runner, Record::Job, &record, -1) != 0);
  CHECK(record.calls[0] == 0);
  CHECK(HardwareWorkers() >= 1);
  CHECK(HardwareWorkers() <= SF_MAX_WORKERS);
}

}  // namespace
}  // namespace starfocus
