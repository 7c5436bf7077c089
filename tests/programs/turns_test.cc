// SPDX-License-Identifier: Apache-2.0
// Tests the order in which the inputs of a batch are refocused.
#include "examples/cli/batch.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace {

using starfocus::Turn;
using starfocus::Turns;

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
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back(serve);
  for (std::thread& thread : threads) thread.join();
  return order;
}

TEST_CASE("Turns: one input at a time, in order, also after an input that fails") {
  for (int repeat = 0; repeat < 20; ++repeat) {
    int most = 0;
    CHECK(RunInputs(1, &most) == std::vector<size_t>{0, 1, 2, 4, 5, 6, 7});
    CHECK(most == 1);
  }
}

TEST_CASE("Turns: at most the given number of inputs at a time") {
  for (int repeat = 0; repeat < 20; ++repeat) {
    int most = 0;
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
    std::vector<std::thread> threads;
    for (size_t k = 0; k < jobs + 1; ++k) threads.emplace_back(serve);
    for (std::thread& thread : threads) thread.join();
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

}  // namespace
