// SPDX-License-Identifier: Apache-2.0
// Tests the order in which jobs are passed to a runner, and that engines in several threads are
// independent.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace workers_test {
namespace {

// Runner that runs all jobs in turn, and records the number of jobs in each set.
struct NotingRunner {
  std::vector<int32_t> sets;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    static_cast<NotingRunner*>(self)->sets.push_back(count);
    for (int32_t index = 0; index < count; ++index) job(data, index, 0);
    return 0;
  }
};

TEST_CASE("workers: each block is a job, and blocks with the largest predicted time come first") {
  // A flat, blurred area begins within the first superblock, so the engine splits this superblock.
  constexpr int kColumns = 3, kSide = 128;
  test::Scene scene = test::RandomScene(kColumns * kSide, kSide, 5, -9, 9, 31);
  for (int y = 0; y < kSide; ++y) {
    float* row = scene.disparity.data() + size_t(y) * scene.disparity_width;
    std::fill(row + kSide / 4, row + scene.width, 9.0F);
  }
  test::Config config = test::ConfigFor(scene);
  config.superblock = kSide;
  test::Engine engine(config);
  const starfocus::Params params = test::Params(-9, 1, STARFOCUS_MODE_BLOCK);
  const auto costs = [&] {
    std::vector<uint64_t> all;
    for (const starfocus::Block& block : test::PlanOf(engine.get()).blocks) {
      all.push_back(block.cost);
    }
    return all;
  };
  test::Output out = test::OutputOf(&engine, params, scene);
  const std::vector<uint64_t> planned = costs();
  REQUIRE(planned.size() > size_t(kColumns));
  CHECK(std::is_sorted(planned.rbegin(), planned.rend()));
  NotingRunner runner;
  REQUIRE(test::Refocus(&engine, params, scene, &out, NotingRunner::Run, &runner) == STARFOCUS_OK);
  CHECK(costs() == planned);
  CHECK(std::count(runner.sets.begin(), runner.sets.end(), int32_t(planned.size())) >= 1);
}

TEST_CASE("workers: engines that refocus in several threads at once do not affect each other") {
  constexpr int kThreads = 4;
  std::vector<test::Scene> scenes;
  std::vector<std::vector<uint8_t>> expected(kThreads), got(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    constexpr int kViews[] = {17, 9, 5, 1};
    scenes.push_back(test::RandomScene(60 + 11 * i, 70, kViews[i], -3, 3, 20 + uint64_t(i)));
    test::Config config = test::ConfigFor(scenes[size_t(i)]);
    config.superblock = 32;
    expected[size_t(i)] = test::RefocusScene(scenes[size_t(i)], config, test::Params(i - 1.5)).rgb;
  }
  std::vector<std::thread> threads;
  std::atomic<int> failures{0};
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      const test::Scene& scene = scenes[size_t(i)];
      test::Config config = test::ConfigFor(scene);
      config.superblock = 32;
      test::Engine engine(config);
      test::Output out(scene.width, scene.height);
      for (int round = 0; round < 3; ++round) {
        failures += test::Refocus(&engine, test::Params(i - 1.5), scene, &out) != STARFOCUS_OK;
      }
      got[size_t(i)] = out.bytes;
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(failures == 0);
  for (size_t i = 0; i < kThreads; ++i) CHECK(got[i] == expected[i]);
}

}  // namespace
}  // namespace workers_test
