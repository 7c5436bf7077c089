// SPDX-License-Identifier: Apache-2.0
// Tests how threads share work: the pool of starfocus/pool.h through its public interface, how its
// threads sleep, wake and fail, the order of the inputs of a batch, and the rows of a picture that
// is encoded while another thread computes them.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <future>
#include <memory>
#include <mutex>
#include <new>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "examples/cli/batch.h"
#include "platform/image.h"
#include "platform/row_gate.h"
#include "platform/runner.h"
#include "platform/writers/picture.h"
#include "starfocus/pool.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace starfocus::threads_test {
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

using Pool = std::unique_ptr<starfocus_pool, void (*)(starfocus_pool*)>;

Pool MakePool(int workers) { return {starfocus_pool_create(workers), starfocus_pool_destroy}; }

void CheckRuns(const Pool& pool, int count) {
  Record record(count);
  record.workers = starfocus_pool_workers(pool.get());
  REQUIRE(starfocus_pool_run(pool.get(), Record::Job, &record, count) == 0);
  CHECK(record.Good(1));
}

TEST_CASE(
    "pool: each job of a batch runs once, by the asked workers, the maximum, or for numbers up to "
    "0 "
    "one worker per usable core") {
  constexpr int kMost = STARFOCUS_MAX_WORKERS;
  const int cores = starfocus_pool_cores();
  CHECK((cores >= 1 && cores <= kMost));
  const std::pair<int, int> rows[] = {{1, 1},         {2, 2},
                                      {5, 5},         {0, cores},
                                      {-1, cores},    {INT32_MIN, cores},
                                      {kMost, kMost}, {INT32_MAX, kMost}};
  for (const auto& [asked, workers] : rows) {
    const Pool pool = MakePool(asked);
    REQUIRE(pool != nullptr);
    CHECK(starfocus_pool_workers(pool.get()) == workers);
    for (int repeat = 0; repeat < 10; ++repeat) {
      for (const int count : {0, 1, 2, 3, 200, 1000}) CheckRuns(pool, count);
    }
  }
}

TEST_CASE("pool: invalid arguments are rejected or clamped") {
  const Pool pool = MakePool(2);
  Record record(1);
  CHECK(starfocus_pool_run(nullptr, Record::Job, &record, 1) != 0);
  CHECK(starfocus_pool_run(pool.get(), nullptr, &record, 1) != 0);
  CHECK(starfocus_pool_run(pool.get(), Record::Job, &record, -1) != 0);
  CHECK(record.calls[0] == 0);
  CHECK(starfocus_pool_workers(nullptr) == 0);
  starfocus_pool_destroy(nullptr);
  ThreadRunner runner(-5);
  CHECK(runner.workers() == 1);
  CHECK(ThreadRunner::Run(nullptr, Record::Job, &record, 1) != 0);
}

TEST_CASE("pool: several pools can exist at once, and one pool can serve several callers in turn") {
  const Pool a = MakePool(3), b = MakePool(2);
  Record shared(300);
  std::vector<std::thread> callers;
  for (const Pool* const pool : {&a, &a, &a, &b}) {
    callers.emplace_back([&, pool] {
      for (int repeat = 0; repeat < 20; ++repeat) {
        if (pool == &a) {
          starfocus_pool_run(a.get(), Record::Job, &shared, 300);
        } else {
          CheckRuns(b, 50);
        }
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  CHECK(shared.Good(60));
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

  const Pool pool = MakePool(4);
  config.max_workers = starfocus_pool_workers(pool.get());
  test::Engine engine(config);
  for (const int stop : {test::Watch::kNever, 20, 0, 5, test::Watch::kNever}) {
    CAPTURE(stop);
    test::Watch watch(stop);
    starfocus_callbacks callbacks = test::ToldTo(test::Watch::Progress, &watch);
    callbacks.runner = starfocus_pool_run;
    callbacks.runner_data = pool.get();
    test::Output out(300, 120);
    const starfocus_status status = test::Refocus(&engine, params, scene, &out, callbacks);
    CHECK(watch.Good());
    CHECK(status == (stop == test::Watch::kNever ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED));
    if (status != STARFOCUS_OK) continue;
    CHECK(watch.Ended());
    CHECK(out.bytes == expected.bytes);
  }
}

// Each worker waits for all other workers, so that the test hangs if a worker does not wake. Then
// all but the caller work for some time.
struct Meeting {
  int workers;
  std::chrono::microseconds time{0};
  std::atomic<int> met{0}, done{0};

  static void Job(void* data, int32_t, int32_t worker) {
    auto* self = static_cast<Meeting*>(data);
    ++self->met;
    while (self->met < self->workers) std::this_thread::yield();
    if (worker != 0) std::this_thread::sleep_for(self->time);
    ++self->done;
  }
};

TEST_CASE(
    "runner: threads wake at any time, run the jobs of a batch at the same time, and the caller "
    "waits for the last job") {
  for (const int workers : {2, 3, 64}) {
    ThreadRunner runner(workers);
    // Batches begin before, while and after the threads fall asleep, or end before, while and after
    // the caller falls asleep.
    for (const int microseconds : {0, 50, 90, 100, 110, 150, 1000}) {
      const std::chrono::microseconds time(microseconds);
      for (int repeat = 0; repeat < (workers == 64 ? 1 : 100); ++repeat) {
        Meeting meeting{workers}, slow{workers, time};
        CHECK(ThreadRunner::Run(&runner, Meeting::Job, &meeting, workers) == 0);
        CHECK(meeting.done == workers);
        std::this_thread::sleep_for(time);
        CHECK(ThreadRunner::Run(&runner, Meeting::Job, &slow, workers) == 0);
        CHECK(slow.done == workers);
      }
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
      CHECK(meeting.done == workers);
    }
  }
}

// Runs a function on several threads, and waits for its ends.
template <class Work>
void RunThreads(size_t count, const Work& work) {
  std::vector<std::thread> threads;
  for (size_t k = 0; k < count; ++k) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
}

// Runs eight inputs on four threads. Input 3 fails before its turn. Returns the inputs in the order
// of their turns, and stores the largest number of turns at the same time in `*most`.
std::vector<size_t> RunInputs(size_t limit, int* most) {
  Turns turns(limit, 100);
  std::mutex mutex;
  std::vector<size_t> order;
  size_t next = 0;
  int now = 0;
  const auto serve = [&] {
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex);
      const size_t input = next++;
      lock.unlock();
      if (input >= 8) return;
      Turn turn(&turns, input);
      if (input == 3) continue;
      turn.Begin();
      lock.lock();
      order.push_back(input);
      *most = std::max(*most, ++now);
      lock.unlock();
      std::this_thread::yield();
      lock.lock();
      --now;
      lock.unlock();
      turn.End(0);
    }
  };
  RunThreads(4, serve);
  return order;
}

TEST_CASE("Turns: inputs begin in order, also after one that fails, at most the given number") {
  for (int repeat = 0; repeat < 20; ++repeat) {
    int most = 0;
    CHECK(RunInputs(1, &most) == std::vector<size_t>{0, 1, 2, 4, 5, 6, 7});
    CHECK(most == 1);
    most = 0;
    CHECK(RunInputs(2, &most).size() == 7);
    CHECK(most <= 2);
  }
}

// Memory that the inputs of a batch hold at present.
struct Memory {
  std::mutex mutex;
  std::multiset<uint64_t> held = {};  // bytes of each input

  // Returns the bytes beside those of the `jobs` largest inputs.
  uint64_t Beside(size_t jobs) const {
    uint64_t sum = 0;
    size_t k = held.size();
    for (const uint64_t bytes : held) sum += k-- > jobs ? bytes : 0;
    return sum;
  }
};

TEST_CASE("Turns: beside the inputs of all jobs, at most the stated bytes are in memory") {
  constexpr uint64_t kMost = 100;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    CAPTURE(seed);
    const size_t jobs = 1 + seed % 3;
    std::mt19937 random(seed);
    std::vector<uint64_t> sizes(20);
    for (uint64_t& size : sizes) size = random() % 3 == 0 ? 101 + random() % 900 : random() % 101;
    Turns turns(jobs, kMost);
    Memory memory;
    std::atomic<size_t> next{0};
    std::atomic<uint64_t> most{0};
    const auto serve = [&] {
      for (size_t i = next++; i < sizes.size(); i = next++) {
        const uint64_t file = sizes[i] / 3;
        Turn turn(&turns, i);
        turn.Take(file);
        turn.Take(sizes[i] - file);
        std::unique_lock<std::mutex> lock(memory.mutex);
        const auto its = memory.held.insert(sizes[i]);
        most = std::max<uint64_t>(most, memory.Beside(jobs));
        lock.unlock();
        if (i % 5 != 4) {  // other inputs fail
          turn.Begin();
          std::this_thread::yield();
          turn.End(sizes[i]);
          std::this_thread::yield();
        }
        lock.lock();
        memory.held.erase(its);
      }
    };
    RunThreads(jobs + 1, serve);
    CHECK(most <= kMost);
  }
}

TEST_CASE("Turns: an input of unknown size waits for its turn") {
  Turns turns(1, 100);
  Turn first(&turns, 0), second(&turns, 1);
  first.Begin();
  std::atomic<bool> begun{false};
  std::thread thread([&] {
    second.Take(1);
    second.Take(UINT64_MAX);
    begun = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(!begun);
  first.End(101);  // too much outside the turn
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(!begun);
  first.End(100);
  thread.join();
  CHECK(begun);
}

// Returns true if a result is not available after 50 ms. A correct program always passes.
template <class T>
bool IsWaiting(const std::future<T>& result) {
  return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout;
}

TEST_CASE("RowGate: WaitFor returns after the row is finished") {
  RowGate gate;
  auto seen = std::async(std::launch::async, [&] { gate.WaitFor(6); });
  CHECK(IsWaiting(seen));
  gate.Finish(6);
  CHECK(IsWaiting(seen));
  gate.Finish(7);
  seen.get();
  gate.Finish(2);  // finished rows stay finished
  gate.WaitFor(6);
  gate.FinishAll();
  gate.WaitFor(1 << 20);
}

TEST_CASE("EncodePicture: a row is read after it is finished") {
  Image whole(40, 33), made(40, 33);
  for (size_t k = 0; k < whole.pixels.size(); ++k) whole.pixels[k] = uint8_t(k * k / 7);
  for (const std::string path : {"a.jpg", "a.png"}) {
    CAPTURE(path);
    std::fill(made.pixels.begin(), made.pixels.end(), uint8_t{0});
    RowGate gate;
    auto encoded =
        std::async(std::launch::async, [&] { return EncodePicture(path, made, {}, &gate); });
    for (int y = 0; y < whole.height; ++y) {
      if (y == 0 || y == whole.height - 1) CHECK(IsWaiting(encoded));
      std::copy_n(whole.row(y), whole.stride(), made.row(y));
      gate.Finish(y + 1);
    }
    const auto expected = EncodePicture(path, whole, {});
    CHECK(*encoded.get() == *expected);
  }
}

}  // namespace
}  // namespace starfocus::threads_test
