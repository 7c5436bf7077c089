// SPDX-License-Identifier: Apache-2.0
// Tests the streaming functions with bad input and with calls in the wrong order.
#include <doctest/doctest.h>

#include <cstring>
#include <limits>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/stream_steps.h"
#include "tests/support/test_scene.h"

namespace abi_stream_test {
namespace {

constexpr int kWidth = 20, kHeight = 90;

struct Fixture {
  test::Scene scene = test::RandomScene(kWidth, kHeight, 9, -2, 2, 3);
  test::Config config = test::ConfigFor(scene, 8);
  starfocus::Params params = test::Params(0.5);
  test::Output out{kWidth, kHeight, 4};

  Fixture() { config.features |= STARFOCUS_FEATURE_STREAMING; }

  starfocus_status Push(starfocus_engine* engine, const starfocus_light_field& field, int rows,
                        int32_t* consumed) {
    return starfocus_stream_push(engine, &field, rows, consumed);
  }
  starfocus_status Pull(starfocus_engine* engine, int rows, int32_t* written) {
    return test::PullRgb(engine, out.bytes.data(), out.stride, rows, written, nullptr);
  }
};

TEST_CASE("stream: calls fail without the streaming feature and without begin") {
  Fixture f;
  int32_t count = 0;
  {
    test::Engine engine(f.config);
    REQUIRE(engine.status() == STARFOCUS_OK);
    CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
    CHECK(f.Pull(engine.get(), 1, &count) == STARFOCUS_ERROR_STATE);
    // A rejected starfocus_stream_begin starts no stream.
    starfocus::Params params = f.params;
    params.aperture = 2;
    CHECK(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_ERROR_RANGE);
    CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
  }
  f.config.features &= ~STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(f.config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  CHECK(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_ERROR_FEATURE);
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_STATE);
  CHECK(f.Pull(engine.get(), 1, &count) == STARFOCUS_ERROR_STATE);
  CHECK(f.out.Untouched());
}

TEST_CASE("stream: push accepts at most as many rows as the picture has") {
  Fixture f;
  test::Engine engine(f.config);
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  int32_t count = -1;
  CHECK(f.Push(engine.get(), f.scene.Field(), kHeight + 1, &count) == STARFOCUS_ERROR_RANGE);
  // A rejected push consumes no row, so the whole picture can still be pushed.
  CHECK(f.Push(engine.get(), f.scene.Field(), 0, &count) == STARFOCUS_OK);
  CHECK(count == 0);
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_OK);
  CHECK(count == 1);
  CHECK(f.Push(engine.get(), f.scene.Field(1), kHeight, &count) == STARFOCUS_ERROR_RANGE);
}

TEST_CASE("stream: a row with a bad disparity is rejected, and the preceding rows are accepted") {
  Fixture f;
  test::Engine engine(f.config);
  const test::Scene good = f.scene;
  test::Output expected(kWidth, kHeight, 4);
  REQUIRE(test::Stream(&engine, f.params, good, &expected, 8, 8) == STARFOCUS_OK);
  const struct {
    float value;
    starfocus_status status;
  } kBad[] = {{std::numeric_limits<float>::quiet_NaN(), STARFOCUS_ERROR_NOT_FINITE},
              {std::numeric_limits<float>::infinity(), STARFOCUS_ERROR_NOT_FINITE},
              {2.5f, STARFOCUS_ERROR_DISPARITY}};
  for (const auto& bad : kBad) {
    for (int row : {0, 1, 3}) {
      CAPTURE(row);
      f.scene.Disparity(kWidth - 1, row) = bad.value;
      REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
      int32_t consumed = -1;
      CHECK(f.Push(engine.get(), f.scene.Field(), 5, &consumed) == bad.status);
      CHECK(consumed == row);
      CHECK(starfocus_engine_problem(engine.get())->x == kWidth - 1);
      CHECK(starfocus_engine_problem(engine.get())->y == row);
      // After a rejected row, the caller may correct the disparities of this row and continue.
      f.scene = good;
      test::Output out(kWidth, kHeight, 4);
      test::StreamSteps steps = {&engine, f.scene, &out, consumed};
      while (!steps.Ended()) REQUIRE(steps.Step() == STARFOCUS_OK);
      CHECK(out.bytes == expected.bytes);
    }
  }
}

TEST_CASE("stream: begin restarts a stream that was stopped halfway") {
  Fixture f;
  test::Engine engine(f.config);
  test::Output whole(kWidth, kHeight, 4);
  REQUIRE(test::Refocus(&engine, f.params, f.scene, &whole) == STARFOCUS_OK);
  // The test stops the stream halfway and then begins a new stream.
  REQUIRE(starfocus_stream_begin(engine.get(), &f.params) == STARFOCUS_OK);
  int32_t count = 0;
  REQUIRE(f.Push(engine.get(), f.scene.Field(), 40, &count) == STARFOCUS_OK);
  REQUIRE(f.Pull(engine.get(), 40, &count) == STARFOCUS_OK);
  test::Output streamed(kWidth, kHeight, 4);
  REQUIRE(test::Stream(&engine, f.params, f.scene, &streamed, 7, 9) == STARFOCUS_OK);
  CHECK(streamed.bytes == whole.bytes);
  // All rows have been pushed, so another push is rejected.
  CHECK(f.Push(engine.get(), f.scene.Field(), 1, &count) == STARFOCUS_ERROR_RANGE);
}

}  // namespace
}  // namespace abi_stream_test
