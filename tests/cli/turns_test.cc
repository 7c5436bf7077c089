// SPDX-License-Identifier: Apache-2.0
// Tests the order in which the inputs of a batch are refocused.
#include "examples/cli/refocus/turns.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <mutex>
#include <thread>
#include <vector>

namespace {

using starfocus::Turn;
using starfocus::Turns;

// Runs eight inputs on four threads. Input 3 fails before its turn. Returns the inputs in the order
// of their turns, and stores the largest number of turns at the same time in `*most`.
std::vector<size_t> RunInputs(size_t limit, int* most) {
  Turns turns(limit);
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
      turn.End();
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

}  // namespace
