// SPDX-License-Identifier: Apache-2.0
// Tests that a stream continues after a failed runner. A pull that is repeated after the
// failure must return the same bytes as the pull of a stream whose runner never fails.
#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"

namespace stream_retry_test {
namespace {

constexpr int kWidth = 150, kHeight = 170;

// Runner that fails for `times` sets of jobs, and runs only half of the jobs of these sets. The
// first failing set has the index `fails_at`.
struct Failing {
  int fails_at, times;
  int sets = 0;

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    Failing& failing = *static_cast<Failing*>(self);
    const int set = failing.sets++;
    const bool fails = set >= failing.fails_at && set < failing.fails_at + failing.times;
    for (int32_t i = 0; i < (fails ? (count + 1) / 2 : count); ++i) job(data, i, 0);
    return fails ? 1 : 0;
  }
};

struct Streamed {
  test::Output out{kWidth, kHeight, 5};
  test::Report report;
  int failures = 0;
};

// Pushes as many rows as possible and pulls `chunk` rows at a time. Repeats each pull whose runner
// failed. Uses a new engine, since memory from an earlier stream could have the right contents by
// chance.
Streamed Stream(const test::Config& config, const starfocus::Params& params,
                const test::Scene& scene, int chunk, Failing* failing) {
  Streamed result;
  test::Engine engine(config);
  const starfocus_callbacks callbacks = test::RunBy(Failing::Run, failing);
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  test::StreamSteps steps = {&engine, scene, &result.out};
  while (!steps.Ended()) {
    const starfocus_status status = steps.Step(chunk, &result.report);
    REQUIRE((status == STARFOCUS_OK || status == STARFOCUS_ERROR_RUNNER));
    result.failures += status != STARFOCUS_OK;
  }
  return result;
}

// Returns surfaces in focus next to surfaces far out of focus, so that all layers are used and
// deblocked.
test::Scene MixedScene() {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -1, 26, 8);
  for (int y = 0; y < kHeight; ++y) {
    const int first = 30 + y / 5;
    for (int x = 0; x < kWidth; ++x) {
      scene.Disparity(x, y) = x < first ? 0.0f : x < first + 25 ? 6.0f : 26.0f;
    }
  }
  return scene;
}

void CheckEqual(const test::Report& report, const test::Report& expected) {
  CHECK(report.n == expected.n);
  CHECK(report.rendered_views == expected.rendered_views);
  CHECK(report.rendered_samples == expected.rendered_samples);
  CHECK(std::memcmp(report.layers, expected.layers, sizeof report.layers) == 0);
  CHECK(report.copied_pixels == expected.copied_pixels);
  CHECK(report.gathered_pixels == expected.gathered_pixels);
}

void CheckRetries(const test::Scene& scene, const starfocus::Params& params, int gather) {
  test::Config config = test::ConfigFor(scene, 28);
  config.superblock = 32;
  config.features |= STARFOCUS_FEATURE_STREAMING;
  config.tuning.gather = gather;
  Failing never = {1 << 20, 0};
  const Streamed expected = Stream(config, params, scene, kHeight, &never);
  REQUIRE(expected.failures == 0);
  const bool all_layers = params.study.mode == STARFOCUS_MODE_BLOCK &&
                          params.study.renderer == STARFOCUS_RENDERER_SLICES;
  for (const starfocus_layer_report& layer : expected.report.layers)
    CHECK((!all_layers || layer.blocks > 0));
  constexpr int kStep = STARFOCUS_EMULATED ? 4 : 1;  // an emulator is twenty times slower
  int failed = 0, tried = 0;
  for (int set = 0; set < never.sets; set += kStep, ++tried) {
    CAPTURE(set);
    Failing failing = {set, set % 3 == 0 ? 2 : 1};
    const Streamed streamed = Stream(config, params, scene, set % 2 == 0 ? kHeight : 7, &failing);
    CHECK(streamed.failures > 0);
    failed += streamed.failures;
    CHECK(streamed.out.bytes == expected.out.bytes);
    CHECK(streamed.out.PaddingUntouched());
    CheckEqual(streamed.report, expected.report);
  }
  CHECK(failed >= tried);
}

TEST_CASE(
    "stream: after a failed runner, a repeated pull returns the rows and report of an undisturbed "
    "stream") {
  const test::Scene scene = MixedScene();
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
    for (const starfocus_renderer renderer : test::kRenderers) {
      for (const int gather : {0, 1}) {
        const bool plain = renderer == STARFOCUS_RENDERER_SLICES && gather == 0;
        if (mode != STARFOCUS_MODE_BLOCK && !plain) continue;
        CAPTURES(mode, renderer, gather);
        starfocus::Params params = test::Params(0, 1, mode, renderer);
        CheckRetries(scene, params, gather);
      }
    }
  }
}

}  // namespace
}  // namespace stream_retry_test
