// SPDX-License-Identifier: Apache-2.0
// Runs a stream in steps. Each step pushes as many rows as the engine consumes, and pulls some
// rows.
#ifndef STARFOCUS_TESTS_SUPPORT_STREAM_STEPS_H_
#define STARFOCUS_TESTS_SUPPORT_STREAM_STEPS_H_

#include <doctest/doctest.h>

#include <algorithm>

#include "starfocus/starfocus.hpp"
#include "tests/support/test_scene.h"

namespace test {

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

#endif  // STARFOCUS_TESTS_SUPPORT_STREAM_STEPS_H_
