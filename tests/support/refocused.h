// SPDX-License-Identifier: Apache-2.0
// Refocuses scenes: whole, in steps of a stream, with memory for prepared light fields, and with a
// progress function that checks its calls.
#ifndef STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
#define STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace test {

struct Watch {
  static constexpr int kNever = -1;

  explicit Watch(int cancel_at = kNever) : stop(cancel_at) {}

  int stop;       // Index of the call that cancels, or kNever.
  int calls = 0;  // Number of calls so far; simultaneous calls are counted in `clashes`.
  int32_t done = 0, rows = 0;
  int full = 0;      // Calls that report all rows as done.
  int back = 0;      // Calls with fewer rows than before, or a wrong total.
  int too_late = 0;  // Calls after the cancellation.
  std::atomic<int> inside{0}, clashes{0};

  static int Progress(void* data, int32_t rows_done, int32_t rows) {
    Watch& self = *static_cast<Watch*>(data);
    if (self.inside.fetch_add(1) != 0) ++self.clashes;
    if (rows_done < self.done || rows_done > rows) ++self.back;
    if (self.rows != 0 && self.rows != rows) ++self.back;
    if (rows_done == rows) ++self.full;
    self.done = rows_done;
    self.rows = rows;
    if (self.stop != kNever && self.calls > self.stop) ++self.too_late;
    const bool cancels = self.calls++ == self.stop;
    self.inside.fetch_sub(1);
    return cancels ? 1 : 0;
  }

  // Returns true if all calls of Progress so far were valid.
  bool Good() const { return back == 0 && too_late == 0 && clashes == 0; }
  bool Ended() const { return Good() && done == rows && full == 1; }
};

class PreparedMemory {
 public:
  explicit PreparedMemory(const Engine& engine) : PreparedMemory(engine.config()) {}
  explicit PreparedMemory(const starfocus_config& config) {
    REQUIRE(starfocus_prepared_size(&config, &bytes, nullptr) == STARFOCUS_OK);
    memory_.assign(bytes + STARFOCUS_ALIGNMENT, kPoison);
  }
  uint8_t* get() {
    const auto address = reinterpret_cast<uintptr_t>(memory_.data());
    return memory_.data() +
           (STARFOCUS_ALIGNMENT - address % STARFOCUS_ALIGNMENT) % STARFOCUS_ALIGNMENT;
  }
  // Prepares a light field in the memory of this object.
  starfocus_prepared* Prepare(starfocus_engine* engine, const starfocus_light_field& field) {
    starfocus_prepared* prepared = nullptr;
    REQUIRE(starfocus_prepare(engine, &field, get(), bytes, &prepared) == STARFOCUS_OK);
    return prepared;
  }

  size_t bytes = 0;

 private:
  std::vector<uint8_t> memory_;
};

// Refocuses a scene and returns the picture, which is as large as the region of `params`.
inline Output OutputOf(Engine* engine, const starfocus::Params& params, const Scene& scene,
                       starfocus_report* report = nullptr,
                       const starfocus_callbacks& callbacks = {}) {
  const starfocus_region& region = params.region;
  Output out(region.width > 0 ? region.width : scene.width,
             region.width > 0 ? region.height : scene.height);
  REQUIRE(Refocus(engine, params, scene, &out, callbacks, report) == STARFOCUS_OK);
  return out;
}

// Refocuses a scene with a new engine and returns the picture.
inline Output OutputOf(const test::Config& config, const starfocus::Params& params,
                       const Scene& scene, starfocus_report* report = nullptr) {
  Engine engine(config);
  return OutputOf(&engine, params, scene, report);
}

struct Refocused {
  std::vector<uint8_t> rgb;  // packed rows
  test::Report report;
};

inline Refocused RefocusScene(const Scene& scene, const test::Config& config,
                              const starfocus::Params& params) {
  Refocused refocused;
  refocused.rgb = OutputOf(config, params, scene, &refocused.report).bytes;
  return refocused;
}

struct StreamSteps {
  bool Ended() const { return pulled == scene.height; }
  // Pushes all rows that the engine consumes, and pulls at most `most` rows. Returns the status of
  // starfocus_stream_pull.
  starfocus_status Step(int most = STARFOCUS_MAX_SIZE, starfocus_report* report = nullptr) {
    int32_t consumed = 0, written = 0;
    if (pushed < scene.height) {
      const starfocus_light_field field = scene.Field(pushed);
      REQUIRE(starfocus_stream_push(engine->get(), &field, scene.height - pushed, &consumed) ==
              STARFOCUS_OK);
    }
    const starfocus_status status =
        PullRgb(engine->get(), out->bytes.data() + size_t(pulled) * out->stride, out->stride,
                std::min(most, scene.height - pulled), &written, report);
    if (status == STARFOCUS_OK) REQUIRE(consumed + written > 0);
    pushed += consumed;
    pulled += written;
    return status;
  }

  Engine* engine;  // an engine whose stream has begun
  const Scene& scene;
  Output* out;
  int pushed = 0, pulled = 0;
};

}  // namespace test

#endif  // STARFOCUS_TESTS_SUPPORT_REFOCUSED_H_
