// SPDX-License-Identifier: Apache-2.0
// Output bytes depend neither on the number of workers nor on the order of the jobs; engines in
// several threads are independent.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace workers_test {
namespace {

// A fresh thread per worker; the jobs are drawn in a shuffled order.
struct ShuffledRunner {
  int workers = 1;
  uint64_t seed = 1;
  int calls = 0;
  int jobs = 0;

  static int Run(void* self, sf_job job, void* data, int32_t count) {
    ShuffledRunner* runner = static_cast<ShuffledRunner*>(self);
    if (count <= 0) return 1;
    ++runner->calls;
    runner->jobs += count;
    test::Random random(runner->seed + static_cast<uint64_t>(runner->calls));
    std::vector<int32_t> order(static_cast<size_t>(count));
    for (int32_t i = 0; i < count; ++i) order[static_cast<size_t>(i)] = i;
    for (size_t i = order.size(); i > 1; --i) {
      std::swap(order[i - 1], order[random.Next() % i]);
    }
    std::atomic<size_t> next{0};
    const auto work = [&](int32_t worker) {
      for (size_t i = next++; i < order.size(); i = next++) job(data, order[i], worker);
    };
    std::vector<std::thread> threads;
    for (int32_t worker = 0; worker < runner->workers; ++worker) threads.emplace_back(work, worker);
    for (std::thread& thread : threads) thread.join();
    return 0;
  }
};

std::vector<uint8_t> Whole(const test::Scene& scene, const sf_params& params, int workers,
                           bool stream, ShuffledRunner* runner) {
  sf_config config = test::ConfigFor(scene);
  config.largest_block = 32;
  config.max_workers = workers;
  test::SetFeature(SF_FEATURE_STREAMING, stream, &config.features);
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  test::Output out(scene.width, scene.height);
  const sf_runner run = runner ? ShuffledRunner::Run : nullptr;
  REQUIRE((stream ? test::Stream(&engine, params, scene, &out, 50, 50, run, runner)
                  : test::Refocus(&engine, params, scene, &out, run, runner)) == SF_OK);
  return out.bytes;
}

TEST_CASE("workers: 1, 2 and 7 give the bytes of no runner at all") {
  for (int views : {17, 9, 5, 1}) {
    for (sf_mode mode : {SF_MODE_FRAME, SF_MODE_BENCHMARK}) {
      const test::Scene scene = test::RandomScene(151, 107, views, -4, 3, 11);
      const sf_params params = test::Params(1, 0.8, mode);
      const std::vector<uint8_t> expected = Whole(scene, params, 1, false, nullptr);
      for (int workers : {1, 2, 7}) {
        for (bool stream : {false, true}) {
          CAPTURE(views);
          CAPTURE(workers);
          CAPTURE(stream);
          ShuffledRunner runner;
          runner.workers = workers;
          runner.seed = static_cast<uint64_t>(workers * 10);
          CHECK(Whole(scene, params, workers, stream, &runner) == expected);
          CHECK(runner.jobs > 1);
        }
      }
    }
  }
}

TEST_CASE("workers: fewer threads than the configuration allows") {
  const test::Scene scene = test::RandomScene(100, 60, 17, -2, 2, 12);
  const sf_params params = test::Params(-1);
  const std::vector<uint8_t> expected = Whole(scene, params, 1, false, nullptr);
  ShuffledRunner runner;
  runner.workers = 3;
  CHECK(Whole(scene, params, SF_MAX_WORKERS, false, &runner) == expected);
}

// Runs all jobs in turn, and notes how many each set has.
struct NotingRunner {
  std::vector<int32_t> sets;

  static int Run(void* self, sf_job job, void* data, int32_t count) {
    static_cast<NotingRunner*>(self)->sets.push_back(count);
    for (int32_t index = 0; index < count; ++index) job(data, index, 0);
    return 0;
  }
};

TEST_CASE("workers: each block is a job, those of the most predicted time come first") {
  // A column of superblocks is split where what is flat and blurred begins.
  constexpr int kColumns = 3, kSide = 128;
  test::Scene scene = test::RandomScene(kColumns * kSide, kSide, 5, -9, 9, 31);
  for (int y = 0; y < kSide; ++y) {
    float* row = scene.disparity.data() + size_t(y) * scene.disparity_width;
    std::fill(row + kSide / 4, row + scene.width, 9.0F);
  }
  sf_config config = test::ConfigFor(scene);
  config.largest_block = kSide;
  test::Engine engine(config);
  REQUIRE(engine.status() == SF_OK);
  const sf_params params = test::Params(-9, 1, SF_MODE_BLOCK);
  const auto costs = [&] {
    std::vector<uint64_t> all;
    for (const starfocus::Block& block : test::PlanOf(engine.get()).blocks) {
      all.push_back(block.cost);
    }
    return all;
  };
  test::Output out(scene.width, scene.height);
  REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
  const std::vector<uint64_t> planned = costs();
  REQUIRE(planned.size() > size_t(kColumns));
  CHECK(std::is_sorted(planned.rbegin(), planned.rend()));
  NotingRunner runner;
  REQUIRE(test::Refocus(&engine, params, scene, &out, NotingRunner::Run, &runner) == SF_OK);
  CHECK(costs() == planned);
  CHECK(std::count(runner.sets.begin(), runner.sets.end(), int32_t(planned.size())) >= 1);
}

TEST_CASE("workers: engines in several threads are independent") {
  constexpr int kThreads = 4;
  std::vector<test::Scene> scenes;
  std::vector<std::vector<uint8_t>> expected(kThreads), got(kThreads);
  for (int i = 0; i < kThreads; ++i) {
    constexpr int kViews[] = {17, 9, 5, 1};
    scenes.push_back(test::RandomScene(60 + 11 * i, 70, kViews[i], -3, 3, 20 + uint64_t(i)));
    expected[size_t(i)] = Whole(scenes[size_t(i)], test::Params(i - 1.5), 1, false, nullptr);
  }
  std::vector<std::thread> threads;
  std::atomic<int> failures{0};
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&, i] {
      const test::Scene& scene = scenes[size_t(i)];
      sf_config config = test::ConfigFor(scene);
      config.largest_block = 32;
      test::Engine engine(config);
      test::Output out(scene.width, scene.height);
      for (int round = 0; round < 3; ++round) {
        failures += test::Refocus(&engine, test::Params(i - 1.5), scene, &out) != SF_OK;
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
