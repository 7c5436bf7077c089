// SPDX-License-Identifier: Apache-2.0
// Tests the number of calls of starfocus_callbacks.progress, and the state of a stream after a
// cancellation.
#include <doctest/doctest.h>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/operations/picture_operations.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"
#include "tests/support/watch.h"

namespace progress_slow_test {
namespace {

using namespace properties;
using test::Watch;

starfocus_callbacks Watched(Watch* watch) { return test::ToldTo(Watch::Progress, watch); }

void SetCallbacks(test::Engine* engine, const starfocus_callbacks& callbacks) {
  REQUIRE(starfocus_set_callbacks(engine->get(), &callbacks) == STARFOCUS_OK);
}

// Pulls all rows of a stream. Each pull is cancelled after `every` calls of the progress function,
// and is then repeated. Returns the number of cancelled pulls, rounded up to an even number.
int PullOn(const Picture& f, int every, starfocus_report* report, test::Output* out) {
  test::Engine engine(f.config);
  Watch watch;
  SetCallbacks(&engine, Watched(&watch));
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  test::StreamSteps steps = {&engine, f.scene, out};
  int cancelled = 0;
  while (!steps.Ended()) {
    watch.stop = cancelled % 2 == 0 ? watch.calls + every : Watch::kNever;
    const starfocus_status status = steps.Step(kHeight, report);
    if (status == STARFOCUS_ERROR_CANCELLED) {
      ++cancelled;
    } else {
      REQUIRE(status == STARFOCUS_OK);
      if (cancelled % 2 != 0) ++cancelled;
    }
    CHECK(watch.Good());
  }
  CHECK(watch.Ended());
  CHECK(watch.rows == kHeight);
  return cancelled;
}

TEST_CASE(
    "progress: after cancelled pulls, a stream returns the rows and report of an undisturbed "
    "stream") {
  const Picture f(SceneOf(kBlocks), kBlocks, {});
  test::Report expected, report;
  test::Output whole(kWidth, kHeight, 5), out(kWidth, kHeight, 5);
  REQUIRE(test::Refocus(f.engine.get(), f.params, f.scene, &whole) == STARFOCUS_OK);
  REQUIRE(PullOn(f, 1 << 20, &expected, &out) == 0);
  CHECK(out.bytes == whole.bytes);
  int cancelled = 0;
  for (int every = 0; every < 40; ++every) {
    CAPTURE(every);
    test::Output again(kWidth, kHeight, 5);
    cancelled += PullOn(f, every, &report, &again);
    CHECK(again.bytes == whole.bytes);
    CHECK(report.rendered_samples == expected.rendered_samples);
  }
  CHECK(cancelled > 40);
}

TEST_CASE("progress: if starfocus_stream_begin is cancelled, no stream has begun") {
  const Picture f(SceneOf(kBlur), kBlur, {});
  test::Engine engine(f.config);  // in blur mode, starfocus_stream_begin computes the PSFs
  Watch watch(0);
  SetCallbacks(&engine, Watched(&watch));
  CHECK(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_ERROR_CANCELLED);
  CHECK(starfocus_engine_problem(engine.get())->status == STARFOCUS_ERROR_CANCELLED);
  const starfocus_light_field field = f.scene.Field();
  int32_t consumed = 0;
  CHECK(starfocus_stream_push(engine.get(), &field, 1, &consumed) == STARFOCUS_ERROR_STATE);
}

// The work between two calls of the progress function is limited, even within a large block. A job
// that computes a single block must therefore call the progress function repeatedly.
TEST_CASE("progress: at most a million samples are computed between two progress calls") {
  constexpr double kMost = 1 << 20;
  for (const Lens& of : kLenses) {
    CAPTURE(of.name);
    if (of.aperture == 0 || of.highlights > 1 || of.layered || of.views == 1) continue;
    const bool gathered = of.flat;
    const int side = gathered ? 128 : 64;
    test::Scene scene = test::RandomScene(side, side, 5, -3, 9, 8);
    if (gathered) scene.disparity.assign(scene.disparity.size(), 9);
    test::Config config = test::ConfigFor(scene, 32);
    config.superblock = side;
    config.tuning.max_layer = 0;
    // As a lower bound of the work for cells that are blurred without views, the test assumes PSFs
    // of half the width.
    const int radius = gathered ? 12 : 32, size = (gathered ? 1 : 2) * radius + 1;
    starfocus::Params params = test::Params(9 - radius, 1, of.mode, of.renderer);
    test::Engine engine(config);
    // The first picture also computes the PSFs, which causes further progress calls. The test
    // therefore counts only the progress calls of the second picture.
    test::Output out = test::OutputOf(&engine, params, scene);
    Watch watch;
    test::Report report;
    REQUIRE(test::Refocus(&engine, params, scene, &out, Watched(&watch), &report) == STARFOCUS_OK);
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

}  // namespace
}  // namespace progress_slow_test
