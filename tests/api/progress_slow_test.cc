// SPDX-License-Identifier: Apache-2.0
// sf_callbacks.progress: what it is told, and that a call it cancels leaves the engine as it was,
// whenever it does.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"
#include "tests/support/watch.h"

namespace progress_slow_test {
namespace {

using test::Watch;

constexpr int kWidth = 70, kHeight = 75;

// One thread per job, two at a time.
int RunOnTwo(void*, sf_job job, void* data, int32_t count) {
  std::thread other([=] {
    for (int32_t i = 1; i < count; i += 2) job(data, i, 1);
  });
  for (int32_t i = 0; i < count; i += 2) job(data, i, 0);
  other.join();
  return 0;
}

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
  test::Scene scene, before;
  sf_config config;
  sf_params params;
  test::Output expected{kWidth, kHeight, 5};  // of a fresh engine
  test::Output previous{kWidth, kHeight, 5};  // of the scene before

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
    before = scene;
    before.Pixel(0, 50, 60)[1] ^= 64;  // a corner of the last stripes differs
    test::Engine engine(config);
    REQUIRE(engine.status() == SF_OK);
    REQUIRE(test::Refocus(&engine, params, scene, &expected) == SF_OK);
    REQUIRE(test::Refocus(&engine, params, before, &previous) == SF_OK);
  }
};

// Callbacks with a watch, which may be null, and a runner.
sf_callbacks Watched(Watch* watch, sf_runner runner = nullptr) {
  sf_callbacks callbacks = test::ToldTo(watch != nullptr ? Watch::Progress : nullptr, watch);
  callbacks.runner = runner;
  return callbacks;
}

void SetCallbacks(test::Engine* engine, const sf_callbacks& callbacks) {
  REQUIRE(sf_set_callbacks(engine->get(), &callbacks) == SF_OK);
}

// The memory of a prepared light field.
struct Prepared {
  std::vector<uint8_t> memory;
  size_t bytes = 0;
  sf_prepared* prepared = nullptr;

  explicit Prepared(const sf_config& config) {
    REQUIRE(sf_prepared_size(&config, &bytes) == SF_OK);
    memory.resize(bytes + SF_ALIGNMENT);
  }
  uint8_t* At() {
    const auto address = reinterpret_cast<uintptr_t>(memory.data());
    return memory.data() + (SF_ALIGNMENT - address % SF_ALIGNMENT) % SF_ALIGNMENT;
  }
  sf_status Prepare(const Fixture& f, test::Engine* engine, Watch* watch, sf_runner runner) {
    const sf_light_field field = f.scene.Field();
    SetCallbacks(engine, Watched(watch, runner));
    return sf_prepare(engine->get(), &field, At(), bytes, &prepared);
  }
};

// A way to ask for the whole picture of the scene. The watch is null where nobody is to be asked.
using Entry = std::function<sf_status(test::Engine*, Watch*, test::Output*)>;

// Cancels at every call there is (of slow builds at the first ones and some of the others), after
// each of which the same engine must make the picture of a fresh one. Returns the calls of the
// entry.
int CheckEntry(const Fixture& f, const Entry& entry) {
  test::Engine engine(f.config);
  int stop = 0;
  for (;; stop += test::kSlow && stop >= 10 ? 7 : 1) {
    CAPTURE(stop);
    Watch watch(stop);
    test::Output out(kWidth, kHeight, 5);
    const sf_status status = entry(&engine, &watch, &out);
    CHECK(watch.Good());
    if (watch.calls <= stop) {  // it ended before
      CHECK(status == SF_OK);
      CHECK(watch.Ended());
      CHECK(out.bytes == f.expected.bytes);
      break;
    }
    REQUIRE(status == SF_ERROR_CANCELLED);
    CHECK(out.PaddingUntouched());
    test::Output again(kWidth, kHeight, 5);
    REQUIRE(entry(&engine, nullptr, &again) == SF_OK);
    CHECK(again.bytes == f.expected.bytes);
  }
  return stop;
}

TEST_CASE("progress: cancelled at any call, in every mode, the engine is as before") {
  for (const Case& of : kCases) {
    CAPTURE(of.what);
    const Fixture f(of);
    for (const sf_runner runner : {sf_runner(nullptr), sf_runner(RunOnTwo)}) {
      CAPTURE(runner == nullptr);
      const int calls = CheckEntry(f, [&](test::Engine* engine, Watch* watch, test::Output* out) {
        return test::Refocus(engine, f.params, f.scene, out, Watched(watch, runner));
      });
      // Three columns of three stripes, and the end.
      CHECK(calls >= 10);
    }
  }
}

TEST_CASE("progress: cancelled frames after others, prepared light fields and streams") {
  for (const Case& of : {kCases[3], kCases[4], kCases[8]}) {
    CAPTURE(of.what);
    const Fixture f(of);
    const sf_light_field field = f.scene.Field();
    CheckEntry(f, [&](test::Engine* engine, Watch* watch, test::Output* out) {
      SetCallbacks(engine, Watched(watch));
      const sf_previous previous = {f.before.Field(),
                                    sf_image_rgb(f.previous.bytes.data(), f.previous.stride)};
      return test::RefocusAfterRgb(engine->get(), &f.params, &field, &previous, out->bytes.data(),
                                   out->stride, nullptr);
    });
    Prepared prepared(f.config);
    test::Engine maker(f.config);
    REQUIRE(prepared.Prepare(f, &maker, nullptr, nullptr) == SF_OK);
    CheckEntry(f, [&](test::Engine* engine, Watch* watch, test::Output* out) {
      SetCallbacks(engine, Watched(watch, RunOnTwo));
      return test::RefocusPreparedRgb(engine->get(), &f.params, prepared.prepared,
                                      out->bytes.data(), out->stride, nullptr);
    });
    CheckEntry(f, [&](test::Engine* engine, Watch* watch, test::Output* out) {
      return test::Stream(engine, f.params, f.scene, out, 9, 7, Watched(watch));
    });
  }
}

TEST_CASE("progress: a preparation that is cancelled gives nothing, and harms nothing") {
  const Fixture f(kCases[4]);
  test::Engine engine(f.config);
  Prepared prepared(f.config);
  for (int stop = 0;; ++stop) {
    CAPTURE(stop);
    Watch watch(stop);
    const sf_status status = prepared.Prepare(f, &engine, &watch, stop % 2 ? RunOnTwo : nullptr);
    CHECK(watch.Good());
    CHECK((prepared.prepared == nullptr) == (status != SF_OK));
    test::Output out(kWidth, kHeight, 5);
    if (status == SF_OK) {
      CHECK(watch.Ended());
      CHECK(watch.rows == kHeight);
      CHECK(stop >= 7);
      SetCallbacks(&engine, {});
      CHECK(test::RefocusPreparedRgb(engine.get(), &f.params, prepared.prepared, out.bytes.data(),
                                     out.stride, nullptr) == SF_OK);
      CHECK(out.bytes == f.expected.bytes);
      break;
    }
    REQUIRE(status == SF_ERROR_CANCELLED);
    REQUIRE(test::Refocus(&engine, f.params, f.scene, &out) == SF_OK);
    CHECK(out.bytes == f.expected.bytes);
  }
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
