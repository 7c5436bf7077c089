// SPDX-License-Identifier: Apache-2.0
// sf_callbacks.progress: what it is told, how often, and what becomes of a stream that it cancels.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/test_scene.h"
#include "tests/support/watch.h"

namespace progress_slow_test {
namespace {

using test::Watch;

constexpr int kWidth = 70, kHeight = 75;

struct Case {
  std::string what;
  sf_mode mode;
  sf_rule rule;
  double aperture;
  float highlights;
  bool flat;  // one surface, which is gathered
};

const Case kCases[] = {
    {"frame, paper", SF_MODE_FRAME, SF_RULE_PAPER, 0.5, 1, false},
    {"frame, subapertures", SF_MODE_FRAME, SF_RULE_SUBAPERTURE, 1, 1, false},
    {"benchmark, slices", SF_MODE_BENCHMARK, SF_RULE_SUBAPERTURE, 0.3, 1, false},
    {"benchmark, paper", SF_MODE_BENCHMARK, SF_RULE_PAPER, 0.3, 1, false},
    {"blocks", SF_MODE_BLOCK, SF_RULE_SUBAPERTURE, 1, 1, false},
    {"blocks, gathered", SF_MODE_BLOCK, SF_RULE_SUBAPERTURE, 1, 1, true},
    {"blocks, paper", SF_MODE_BLOCK, SF_RULE_PAPER, 0.5, 1, false},
    {"blocks, highlights", SF_MODE_BLOCK, SF_RULE_SUBAPERTURE, 1, 4, false},
    {"blur", SF_MODE_BLUR, SF_RULE_DEFAULT, 1, 1, false},
    {"pinhole", SF_MODE_BLOCK, SF_RULE_DEFAULT, 0, 1, false},
};

struct Fixture {
  test::Scene scene;
  sf_config config;
  sf_params params;
  test::Output expected{kWidth, kHeight, 5};  // of a fresh engine

  explicit Fixture(const Case& of) : scene(test::RandomScene(kWidth, kHeight, 5, -3, 9, 8)) {
    if (of.flat) scene.disparity.assign(scene.disparity.size(), 9);
    // Bright squares are lamps.
    for (auto& picture : scene.pictures) {
      for (int y = 40; y < 44; ++y) {
        for (int x = 3 * 30; x < 3 * 34; ++x) picture[size_t(y) * scene.stride + size_t(x)] = 255;
      }
    }
    config = test::ConfigFor(scene, 12);
    config.largest_block = 32;
    config.features |= SF_FEATURE_STREAMING;
    config.max_workers = 2;
    config.highlights = of.highlights;
    params = test::Params(-3, of.aperture, of.mode);
    params.rule = of.rule;
    test::Engine engine(config);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == SF_OK);
  }
};

sf_callbacks Watched(Watch* watch) { return test::ToldTo(Watch::Progress, watch); }

void SetCallbacks(test::Engine* engine, const sf_callbacks& callbacks) {
  REQUIRE(sf_set_callbacks(engine->get(), &callbacks) == SF_OK);
}

TEST_CASE("progress: of a region its rows are told") {
  const Fixture f(kCases[4]);
  test::Engine engine(f.config);
  sf_region region = {21, 17, 30, 41};
  test::Output out(region.width, region.height);
  Watch watch;
  sf_params params = f.params;
  params.region = region;
  REQUIRE(test::Refocus(&engine, params, f.scene, &out) == SF_OK);  // makes the kernels
  REQUIRE(test::Refocus(&engine, params, f.scene, &out, Watched(&watch)) == SF_OK);
  CHECK(watch.Ended());
  CHECK(watch.rows == 41);
  // What a call has worked since it last asked counts for the next call, which may ask once less.
  for (int stop = 0; stop + 1 < watch.calls; ++stop) {
    Watch cancels(stop);
    CHECK(test::Refocus(&engine, params, f.scene, &out, Watched(&cancels)) == SF_ERROR_CANCELLED);
    CHECK(cancels.Good());
  }
}

// Pulls a stream, again whenever it is cancelled, which every pull is after `every` more calls.
int PullOn(const Fixture& f, int every, sf_report* report, test::Output* out) {
  test::Engine engine(f.config);
  Watch watch;
  SetCallbacks(&engine, Watched(&watch));
  REQUIRE(sf_stream_begin(engine.get(), &f.params) == SF_OK);
  int pushed = 0, pulled = 0, cancelled = 0;
  while (pulled < kHeight) {
    const sf_light_field field = f.scene.Field(pushed);
    int32_t consumed = 0, written = 0;
    if (pushed < kHeight) {
      REQUIRE(sf_stream_push(engine.get(), &field, kHeight - pushed, &consumed) == SF_OK);
    }
    watch.stop = cancelled % 2 == 0 ? watch.calls + every : Watch::kNever;
    const sf_status status =
        test::PullRgb(engine.get(), out->bytes.data() + size_t(pulled) * out->stride, out->stride,
                      kHeight - pulled, &written, report);
    pushed += consumed;
    pulled += written;
    if (status == SF_ERROR_CANCELLED) {
      ++cancelled;
    } else {
      REQUIRE(status == SF_OK);
      REQUIRE(consumed + written > 0);
      if (cancelled % 2 != 0) ++cancelled;
    }
    CHECK(watch.Good());
  }
  CHECK(watch.Ended());
  CHECK(watch.rows == kHeight);
  return cancelled;
}

TEST_CASE("progress: a stream that was cancelled goes on with its rows, and the same report") {
  const Fixture f(kCases[4]);
  sf_report expected = {}, report = {};
  test::Output out(kWidth, kHeight, 5);
  REQUIRE(PullOn(f, 1 << 20, &expected, &out) == 0);
  CHECK(out.bytes == f.expected.bytes);
  int cancelled = 0;
  for (int every = 0; every < 40; ++every) {
    CAPTURE(every);
    test::Output again(kWidth, kHeight, 5);
    cancelled += PullOn(f, every, &report, &again);
    CHECK(again.bytes == f.expected.bytes);
    CHECK(report.rendered_samples == expected.rendered_samples);
    CHECK(report.disparity_bytes == expected.disparity_bytes);
  }
  CHECK(cancelled > 40);
}

TEST_CASE("progress: a stream that is cancelled as it begins has not begun") {
  Fixture f(kCases[8]);  // its kernels are made then
  test::Engine engine(f.config);
  Watch watch(0);
  SetCallbacks(&engine, Watched(&watch));
  CHECK(sf_stream_begin(engine.get(), &f.params) == SF_ERROR_CANCELLED);
  const sf_light_field field = f.scene.Field();
  int32_t consumed = 0;
  CHECK(sf_stream_push(engine.get(), &field, 1, &consumed) == SF_ERROR_STATE);
}

// What lies between two questions is bounded by work, and not by blocks: one block of one job must
// ask again and again.
TEST_CASE("progress: whatever a block takes, a million samples are too many to wait for") {
  constexpr double kMost = 1 << 20;
  for (const Case& of : kCases) {
    CAPTURE(of.what);
    if (of.aperture == 0 || of.highlights > 1) continue;
    const bool gathered = of.flat;
    const int side = gathered ? 128 : 64;
    test::Scene scene = test::RandomScene(side, side, 5, -3, 9, 8);
    if (gathered) scene.disparity.assign(scene.disparity.size(), 9);
    sf_config config = test::ConfigFor(scene, 32);
    config.largest_block = side;
    config.tuning.max_layer = 0;
    // Every second pixel counts in what is gathered.
    const int radius = gathered ? 12 : 32, size = (gathered ? 1 : 2) * radius + 1;
    sf_params params = test::Params(9 - radius, 1, of.mode);
    params.rule = of.rule;
    test::Engine engine(config);
    test::Output out(side, side);
    // The kernels, that its first picture makes, are asked between, too.
    REQUIRE(test::Refocus(&engine, params, scene, &out) == SF_OK);
    Watch watch;
    sf_report report = {};
    REQUIRE(test::Refocus(&engine, params, scene, &out, Watched(&watch), &report) == SF_OK);
    CHECK(watch.Ended());
    double samples =
        double(report.rendered_samples) + 3.0 * size * size * double(report.gathered_pixels);
    if (of.mode == SF_MODE_BLUR) samples = 3.0 * 64 * 64 * 49 * 49;  // of the least blur, at least
    CAPTURE(samples);
    CHECK(samples > 4 * kMost);
    CHECK(watch.calls >= samples / kMost);
  }
}

}  // namespace
}  // namespace progress_slow_test
