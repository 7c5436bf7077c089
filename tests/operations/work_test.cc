// SPDX-License-Identifier: Apache-2.0
// Tests how much an engine computes, and when: jobs, progress calls, regions, and blocks of the
// previous frame. operations_bytes_test.cc tests the bytes.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <thread>
#include <vector>

#include "starfocus/starfocus.hpp"
#include "tests/operations/picture_operations.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/scenes.h"

namespace work_test {
namespace {

uint64_t BlocksOf(const test::Report& report) {
  return report.layers[0].blocks + report.layers[1].blocks + report.layers[2].blocks;
}

// Runner that runs all jobs in turn, and records the number of jobs in each set.
struct NotingRunner {
  std::vector<int32_t> sets;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    static_cast<NotingRunner*>(self)->sets.push_back(count);
    for (int32_t index = 0; index < count; ++index) job(data, index, 0);
    return 0;
  }
};

TEST_CASE("jobs: each block is a job, and blocks with the largest predicted time come first") {
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

TEST_CASE("jobs: engines that refocus in several threads at once do not affect each other") {
  struct Task {
    test::Scene scene;
    starfocus::Params params;
    test::Output expected, got;
  };
  std::vector<Task> tasks;
  const auto config_of = [](const test::Scene& scene) {
    test::Config config = test::ConfigFor(scene);
    config.superblock = 32;
    return config;
  };
  for (const int views : test::kStars) {
    const test::Scene scene = test::RandomScene(60 + views, 70, views, -3, 3, uint64_t(views));
    const starfocus::Params params = test::Params(views / 10.0 - 1);
    const test::Output expected = test::OutputOf(config_of(scene), params, scene);
    tasks.push_back({scene, params, expected, test::Output(scene.width, scene.height)});
  }
  std::vector<std::thread> threads;
  std::atomic<int> failures{0};
  for (Task& task : tasks) {
    threads.emplace_back([&] {
      test::Engine engine(config_of(task.scene));
      for (int round = 0; round < 3; ++round) {
        failures += test::Refocus(&engine, task.params, task.scene, &task.got) != STARFOCUS_OK;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(failures == 0);
  for (const Task& task : tasks) CHECK((task.got.bytes == task.expected.bytes));
}

// The work between two calls of the progress function is limited, even within a large block. A job
// that computes a single block must therefore call the progress function repeatedly.
TEST_CASE("progress: at most a million samples are computed between two progress calls") {
  constexpr double kMost = 1 << 20;
  for (const properties::Lens& of : properties::kLenses) {
    CAPTURE(of.name);
    if (of.aperture == 0 || of.highlights > 1 || of.gather == 0 || of.views == 1) continue;
    const bool gathered = of.scene == properties::Lens::kFlat;
    const int side = gathered ? 128 : 64;
    test::Scene scene = test::RandomScene(side, side, 5, -3, 9, 8);
    if (gathered) scene.disparity.assign(scene.disparity.size(), 9);
    test::Config config = test::ConfigFor(scene, 32);
    config.superblock = side;
    config.tuning.max_layer = 0;
    // As a lower bound of the work for cells that are blurred without views, the test assumes PSFs
    // of half the width.
    const int radius = gathered ? 12 : 32, size = (gathered ? 1 : 2) * radius + 1;
    const starfocus::Params params = test::Params(9 - radius, 1, of.mode, of.renderer);
    test::Engine engine(config);
    // The first picture also computes the PSFs, which causes further progress calls. The test
    // therefore counts only the progress calls of the second picture.
    test::Output out = test::OutputOf(&engine, params, scene);
    test::Watch watch;
    test::Report report;
    REQUIRE(test::Refocus(&engine, params, scene, &out, test::ToldTo(test::Watch::Progress, &watch),
                          &report) == STARFOCUS_OK);
    CHECK(watch.Ended());
    double samples =
        double(report.rendered_samples) + 3.0 * size * size * double(report.gathered_pixels);
    if (of.mode == STARFOCUS_MODE_BLUR)
      samples = 3.0 * 64 * 64 * 49 * 49;  // assumes PSFs with a radius of 24
    CAPTURE(samples);
    CHECK(samples > 4 * kMost);
    CHECK(watch.calls >= samples / kMost);
  }
}

TEST_CASE("regions: only the region and its surroundings are rendered") {
  const test::Scene scene = test::LayeredScene(640, 640, 5, 4, 9);
  test::Config config = test::ConfigFor(scene, 8);
  config.superblock = 32;
  test::Engine engine(config);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
    starfocus::Params params = test::Params(1, 1, mode);
    test::Output out(20, 20);
    test::Report report, part;
    const test::Output whole = test::OutputOf(&engine, params, scene, &report);
    int told = 0;
    const starfocus_observer observer = test::Visitor(
        [](void* data, const starfocus_block*) { ++*static_cast<int*>(data); }, &told);
    const starfocus_callbacks counts = test::ObservedBy(&observer);
    params.region = {326, 326, 20, 20};  // inside one superblock
    REQUIRE(test::Refocus(&engine, params, scene, &out, counts, &part) == STARFOCUS_OK);
    CHECK(BlocksOf(part) == uint64_t(told));
    CHECK(BlocksOf(part) > 0);
    CHECK(BlocksOf(part) <= 4);
    CHECK(part.r_max == report.r_max);
    CHECK(part.rendered_samples * 100 < report.rendered_samples);
    params.region = {319, 319, 2, 2};  // Four superblocks meet in this region.
    REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &part) == STARFOCUS_OK);
    CHECK(BlocksOf(part) == 4);
  }
}

TEST_CASE("regions: each row with a bad disparity is either rejected before output or never read") {
  constexpr int kHeight = 240;
  test::Scene scene = test::LayeredScene(40, kHeight, 5, 3, 4);
  test::Config config = test::ConfigFor(scene, 4);
  config.superblock = 32;
  // The search for coverage would read rows that are farther away from the region.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  test::Engine engine(config);
  constexpr starfocus_region kRegions[] = {
      {0, 0, 0, 0}, {3, 0, 30, 9}, {3, 70, 30, 9}, {0, 120, 40, 50}, {3, 231, 30, 9}};
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
    for (const starfocus_region& region : kRegions) {
      CAPTURES(mode, region.y);
      starfocus::Params params = test::Params(0, 1, mode);
      params.region = region;
      const test::Output good = test::OutputOf(&engine, params, scene);
      int refused = 0;
      for (int row = 0; row < kHeight; ++row) {
        test::Output out(good.width, good.height);
        const float kept = scene.Disparity(5, row);
        scene.Disparity(5, row) = row % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : 4.5F;
        const starfocus_status status = test::Refocus(&engine, params, scene, &out);
        scene.Disparity(5, row) = kept;
        const starfocus_status refusal =
            row % 2 == 0 ? STARFOCUS_ERROR_NOT_FINITE : STARFOCUS_ERROR_DISPARITY;
        refused += status == refusal;
        const bool right =
            status == STARFOCUS_OK ? out.bytes == good.bytes : status == refusal && out.Untouched();
        CHECK_MESSAGE(right, "row ", row);
      }
      CHECK(refused >= good.height);
      CHECK((refused < kHeight || region.width == 0));
    }
  }
}

starfocus_status After(test::Engine* engine, const starfocus::Params& params,
                       const test::Scene& scene, const test::Scene& before,
                       const test::Output& before_out, test::Output* out,
                       starfocus_report* report) {
  const starfocus_light_field field = scene.Field();
  const starfocus_light_field before_field = before.Field();
  const starfocus_image before_image =
      starfocus_image_rgb(before_out.bytes.data(), before_out.stride);
  const starfocus_previous previous = {sizeof previous, &before_field, &before_image};
  return test::RefocusAfterRgb(engine->get(), &params, &field, &previous, out->bytes.data(),
                               out->stride, report);
}

TEST_CASE("previous frame: blocks far from a change are reused") {
  struct Row {
    starfocus_mode mode;
    int x, view;      // changed pixel; view -1: none
    int least, most;  // bounds of the number of reused blocks, of 80
  };
  constexpr Row kRows[] = {{STARFOCUS_MODE_BLOCK, 40, 3, 80 - 12, 79},
                           {STARFOCUS_MODE_BLOCK, 40, 0, 80 - 12, 79},
                           {STARFOCUS_MODE_BLOCK, 40, -1, 80, 80},
                           {STARFOCUS_MODE_FRAME, 40, -1, 80, 80},
                           // blur mode reads only the centre view
                           {STARFOCUS_MODE_BLUR, 40, 3, 80, 80},
                           {STARFOCUS_MODE_BLUR, 40, 0, 80 - 12, 79}};
  const test::Scene before = test::LayeredScene(640, 512, 5, 2, 6);
  test::Config config = test::ConfigFor(before, 4);
  // The search for coverage would read pixels farther away from the change.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  test::Engine engine(config);
  for (const Row& row : kRows) {
    CAPTURES(row.mode, row.view);
    const starfocus::Params params = test::Params(0, 1, row.mode);
    test::Output second(640, 512);
    test::Report whole, report;
    const test::Output first = test::OutputOf(&engine, params, before, &whole);
    test::Scene now = before;
    if (row.view >= 0) now.Pixel(row.view, row.x, 30)[1] ^= 1;
    REQUIRE(After(&engine, params, now, before, first, &second, &report) == STARFOCUS_OK);
    CHECK(whole.reused_blocks == 0);
    CHECK(report.reused_blocks >= uint64_t(row.least));
    CHECK(report.reused_blocks <= uint64_t(row.most));
    CHECK(report.rendered_samples <= whole.rendered_samples / 2);
    if (row.least == 80) CHECK(report.rendered_samples == 0);
  }
}

TEST_CASE("previous frame: a change of a side view reaches blocks up to the largest disparity") {
  const test::Scene before = test::NearScene(70, 900, 5, 13);
  test::Config config = test::ConfigFor(before, 8);
  config.superblock = 32;
  test::Engine engine(config);
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
    const starfocus::Params params = test::Params(test::kNearFocus, 0.2, mode);
    const test::Output first = test::OutputOf(&engine, params, before);
    for (int view = 1; view < 5; ++view) {
      CAPTURE(view);
      test::Scene scene = before;
      for (int x = 0; x < 70; ++x) {
        for (int y = 445; y < 455; ++y) scene.Pixel(view, x, y)[1] ^= 0xFF;
      }
      test::Output second(70, 900);
      test::Report report;
      REQUIRE(After(&engine, params, scene, before, first, &second, &report) == STARFOCUS_OK);
      const test::Output expected = test::OutputOf(&engine, params, scene);
      CHECK((second.bytes == expected.bytes));
      CHECK((expected.bytes != first.bytes));
      CHECK(report.reused_blocks > 0);
    }
  }
}

TEST_CASE("previous frame: if the layer of a block changes, its boundaries are deblocked again") {
  // With the timing model of this test, the engine divides no superblock into smaller blocks. A
  // single pixel in focus is enough to keep a block at layer 0.
  test::Scene scene = test::LayeredScene(600, 600, 1, 6, 5);
  std::fill(scene.disparity.begin(), scene.disparity.end(), 6.0f);
  scene.Disparity(500, 5) = scene.Disparity(5, 500) = 0;
  test::Config config = test::ConfigFor(scene, 6);
  config.superblock = 256;
  config.tuning.deblocking = 255;
  config.tuning.timing = {};
  config.tuning.timing.block = STARFOCUS_MAX_TIMING;
  const starfocus::Params params =
      test::Params(0, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
  test::Engine engine(config);
  test::Output second(600, 600);
  test::Report report;
  const test::Output first = test::OutputOf(&engine, params, scene);
  const test::Scene before = scene;
  scene.Disparity(5, 5) = 0;
  REQUIRE(After(&engine, params, scene, before, first, &second, &report) == STARFOCUS_OK);
  CHECK((second.bytes == test::OutputOf(&engine, params, scene).bytes));
  CHECK(report.reused_blocks == 5);  // The engine reuses all 9 blocks except the upper left 4.
  // Deblocking must change pixels to the right of the changed block and below it.
  bool right = false, below = false;
  for (int k = 20; k < 200; ++k) {
    right = right || !std::equal(second.Pixel(256, k), second.Pixel(257, k), first.Pixel(256, k));
    below =
        below || !std::equal(second.Pixel(k, 256), second.Pixel(k + 1, 256), first.Pixel(k, 256));
  }
  CHECK(right);
  CHECK(below);
}

}  // namespace
}  // namespace work_test
