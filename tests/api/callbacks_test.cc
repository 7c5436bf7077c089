// SPDX-License-Identifier: Apache-2.0
// Tests how long the engine uses the functions that starfocus_set_callbacks sets.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/prepared_memory.h"
#include "tests/support/refocused.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"

namespace callbacks_test {
namespace {

constexpr int kWidth = 70, kHeight = 75;

// Counts the calls of each callback.
struct Calls {
  int runner = 0, progress = 0, blocks = 0;
  starfocus_observer observer = {};

  static int Run(void* self, starfocus_job job, void* data, int32_t count) {
    ++static_cast<Calls*>(self)->runner;
    for (int32_t i = 0; i < count; ++i) job(data, i, 0);
    return 0;
  }
  static int Tell(void* self, int32_t, int32_t) {
    ++static_cast<Calls*>(self)->progress;
    return 0;
  }
  static void Visit(void* self, const starfocus_block*) { ++static_cast<Calls*>(self)->blocks; }

  starfocus_callbacks All() {
    observer = {sizeof observer, [](void*) { return uint64_t{0}; }, nullptr, Visit, this};
    return {Run, this, Tell, this, &observer};
  }
  // Returns true if all callbacks were called, and resets the numbers of calls.
  bool Take() {
    const bool all = runner > 0 && progress > 0 && blocks > 0;
    *this = Calls();
    return all;
  }
  bool None() const { return runner == 0 && progress == 0 && blocks == 0; }
};

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 5, -3, 9, 8);
  starfocus::Params params = test::Params(-3, 1, STARFOCUS_MODE_BLOCK);
  starfocus_light_field field = scene.Field();
  test::Output out{kWidth, kHeight};
  Calls calls;

  test::Config Config() const {
    test::Config config = test::ConfigFor(scene, 12);
    config.superblock = 32;
    config.features |= STARFOCUS_FEATURE_STREAMING;
    config.previews = 1;
    return config;
  }
  starfocus_status Refocus(test::Engine* engine) {
    return test::RefocusRgb(engine->get(), &params, &field, out.bytes.data(), out.stride, nullptr);
  }
};

TEST_CASE("callbacks: the engine calls the set functions until other functions are set") {
  Fixture f;
  test::Engine engine(f.Config());
  starfocus_callbacks callbacks = f.calls.All();
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  callbacks = {};  // the engine keeps a copy of the callbacks
  for (int round = 0; round < 2; ++round) {
    REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
    CHECK(f.calls.Take());
  }
  test::PreparedMemory memory(engine);
  const starfocus_prepared* prepared = memory.Prepare(engine.get(), f.field);
  CHECK(f.calls.runner > 0);
  CHECK(f.calls.progress > 0);
  test::Output preview((kWidth + 1) / 2, (kHeight + 1) / 2);
  REQUIRE(test::PreviewRgb(engine.get(), &f.params, prepared, 1, preview.bytes.data(),
                           preview.stride, nullptr) == STARFOCUS_OK);
  CHECK(f.calls.Take());
  REQUIRE(test::RefocusPreparedRgb(engine.get(), &f.params, prepared, f.out.bytes.data(),
                                   f.out.stride, nullptr) == STARFOCUS_OK);
  CHECK(f.calls.Take());
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
  CHECK(f.calls.None());
}

TEST_CASE("callbacks: wrong pointers are rejected, and the previous functions remain in use") {
  Fixture f;
  test::Engine engine(f.Config());
  const starfocus_callbacks callbacks = f.calls.All();
  CHECK(starfocus_set_callbacks(nullptr, &callbacks) == STARFOCUS_ERROR_NULL);
  REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
  CHECK(starfocus_set_callbacks(engine.get(), nullptr) == STARFOCUS_ERROR_NULL);
  const starfocus_observer not_initialized = {};
  const starfocus_callbacks wrong = {nullptr, nullptr, nullptr, nullptr, &not_initialized};
  CHECK(starfocus_set_callbacks(engine.get(), &wrong) == STARFOCUS_ERROR_STRUCTURE);
  REQUIRE(f.Refocus(&engine) == STARFOCUS_OK);
  CHECK(f.calls.Take());
}

// Copies the finished rows of a picture whenever the progress callback runs.
struct FinishedRows {
  const test::Output* out;
  std::vector<std::vector<uint8_t>> copies;

  static int Copy(void* data, int32_t rows_done, int32_t) {
    FinishedRows* self = static_cast<FinishedRows*>(data);
    const auto begin = self->out->bytes.begin();
    const auto size = ptrdiff_t(self->out->stride) * rows_done;
    if (self->copies.empty() || self->copies.back().size() < size_t(size)) {
      self->copies.emplace_back(begin, begin + size);
    }
    return 0;
  }
};

// Runs jobs with even indices as worker 0 and jobs with odd indices as worker 1.
int RunOnTwo(void*, starfocus_job job, void* data, int32_t count) {
  std::thread other([=] {
    for (int32_t i = 1; i < count; i += 2) job(data, i, 1);
  });
  for (int32_t i = 0; i < count; i += 2) job(data, i, 0);
  other.join();
  return 0;
}

TEST_CASE("callbacks: rows that are reported as finished are complete and do not change") {
  constexpr int kSide = 32;
  test::Scene scene = test::LayeredScene(100, 170, 5, 12, 5);
  // Blocks of different layers are adjacent, so that rows above a superblock are deblocked late.
  test::SetDisparity(&scene,
                     [](int x, int y) { return (x / kSide + y / kSide) % 2 == 0 ? 0.0f : 11.0f; });
  test::Config config = test::ConfigFor(scene, 13);
  config.superblock = kSide;
  config.max_workers = 2;
  config.tuning.deblocking = 255;
  test::Engine engine(config);
  for (const starfocus_region region : {starfocus_region{0, 0, 0, 0}, {5, 21, 70, 120}}) {
    starfocus::Params params = test::Params(-1, 1, STARFOCUS_MODE_BLOCK);
    params.region = region;
    test::Output out(region.width > 0 ? region.width : 100, region.width > 0 ? region.height : 170);
    FinishedRows rows = {&out, {}};
    starfocus_callbacks callbacks = {};
    callbacks.runner = RunOnTwo;
    callbacks.progress = FinishedRows::Copy;
    callbacks.progress_data = &rows;
    REQUIRE(test::Refocus(&engine, params, scene, &out, callbacks, nullptr) == STARFOCUS_OK);
    REQUIRE(rows.copies.size() > 3);
    for (const std::vector<uint8_t>& copy : rows.copies) {
      CHECK(std::equal(copy.begin(), copy.end(), out.bytes.begin()));
    }
  }
}

TEST_CASE("callbacks: the functions of a stream may change between two pulls") {
  Fixture f;
  test::Engine engine(f.Config());
  const test::Output expected = test::OutputOf(&engine, f.params, f.scene);
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  test::StreamSteps steps = {&engine, f.scene, &f.out};
  for (int round = 0; !steps.Ended(); ++round) {
    const starfocus_callbacks callbacks = round % 2 == 0 ? f.calls.All() : starfocus_callbacks();
    REQUIRE(starfocus_set_callbacks(engine.get(), &callbacks) == STARFOCUS_OK);
    REQUIRE(steps.Step() == STARFOCUS_OK);
    CHECK(f.calls.None() == (round % 2 != 0));
    f.calls = Calls();
  }
  CHECK(f.out.bytes == expected.bytes);
}

}  // namespace
}  // namespace callbacks_test
