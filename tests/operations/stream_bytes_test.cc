// SPDX-License-Identifier: Apache-2.0
// Tests that streamed rows equal the rows of a whole picture, and that the memory of a stream does
// not depend on the picture's height.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace stream_bytes_test {
namespace {

void CheckSame(const test::Scene& scene, const starfocus::Params& params, int block) {
  test::Config config = test::ConfigFor(scene);
  config.superblock = block;
  test::CheckStreamed(scene, config, params);
}

TEST_CASE(
    "stream: the result is the same as without streaming for every size, star set and chunk") {
  constexpr int kSizes[][2] = {{1, 1},   {1, 5},   {5, 1},   {2, 3},    {3, 31},  {31, 33},
                               {33, 65}, {64, 64}, {65, 32}, {40, 130}, {130, 97}};
  for (const auto& size : kSizes) {
    for (int views : {1, 5, 9, 17}) {
      CAPTURES(size[0], size[1], views);
      const uint64_t seed = static_cast<uint64_t>(size[0] * 1000 + size[1]);
      const test::Scene scene = test::RandomScene(size[0], size[1], views, -3, 4, seed, 5);
      CheckSame(scene, test::Params(0.75), 32);
    }
  }
}

TEST_CASE(
    "stream: the result is the same as without streaming for other lenses, modes and blocks") {
  const test::Scene scene = test::RandomScene(75, 140, 17, -5, 5, 42, 3);
  CheckSame(scene, test::Params(-5.5, 0.5), 32);
  CheckSame(scene, test::Params(9, 1), 64);
  CheckSame(scene, test::Params(0.1, 0.33, STARFOCUS_MODE_BENCHMARK), 32);
  CheckSame(scene, test::Params(2, 1), 128);
}

TEST_CASE("stream: rows of side views remain available up to the largest disparity away") {
  const test::Scene scene = test::NearScene(70, 400, 5, 12);
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK}) {
    CAPTURE(mode);
    CheckSame(scene, test::Params(test::kNearFocus, 0.2, mode), 32);
  }
}

TEST_CASE("stream: the strides of the input pictures do not affect the result") {
  const test::Scene tight = test::RandomScene(50, 70, 9, -2, 2, 8);
  test::Scene padded = test::EmptyScene(50, 70, 9, -2, 2, 21);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 50; ++x) {
      padded.Disparity(x, y) = tight.Disparity(x, y);
      for (int view = 0; view < 9; ++view) {
        std::copy_n(tight.Pixel(view, x, y), 3, padded.Pixel(view, x, y));
      }
    }
  }
  test::Config config = test::ConfigFor(tight);
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  test::Output b(50, 70, 1), c(50, 70, 40);
  const test::Output a = test::OutputOf(&engine, test::Params(1), tight);
  REQUIRE(test::Refocus(&engine, test::Params(1), padded, &b) == STARFOCUS_OK);
  REQUIRE(test::Stream(&engine, test::Params(1), padded, &c, 11, 5) == STARFOCUS_OK);
  CHECK(a.bytes == b.Tight());
  CHECK(a.bytes == c.Tight());
  CHECK(b.PaddingUntouched());
  CHECK(c.PaddingUntouched());
}

TEST_CASE("stream: a picture of 20,000 rows fits the workspace of a picture of 200 rows") {
  constexpr int kWidth = 24, kTall = 20000;
  const test::Scene scene = test::RandomScene(kWidth, kTall, 17, -2, 2, 77);
  test::Config config = test::ConfigFor(scene);
  size_t tall_bytes = 0, low_bytes = 0;
  for (int streaming : {0, 1}) {
    test::SetFeature(STARFOCUS_FEATURE_STREAMING, streaming, &config.features);
    config.height = kTall;
    REQUIRE(starfocus_workspace_size(&config, &tall_bytes, nullptr) == STARFOCUS_OK);
    config.height = 200;
    REQUIRE(starfocus_workspace_size(&config, &low_bytes, nullptr) == STARFOCUS_OK);
    CHECK(tall_bytes == low_bytes);
  }
  // The ring buffers hold fewer than 20,000 rows, so a single push must not consume all rows.
  config.height = kTall;
  test::Engine engine(config);
  REQUIRE(engine.bytes() == low_bytes);
  const starfocus::Params params = test::Params(0.5);
  REQUIRE(starfocus_stream_begin(engine.get(), &params) == STARFOCUS_OK);
  const starfocus_light_field field = scene.Field();
  int32_t consumed = 0;
  REQUIRE(starfocus_stream_push(engine.get(), &field, kTall, &consumed) == STARFOCUS_OK);
  CHECK(consumed > 0);
  CHECK(consumed < 2000);

  test::Output streamed(kWidth, kTall);
  REQUIRE(test::Stream(&engine, params, scene, &streamed, 100, 100) == STARFOCUS_OK);
  config.features &= ~STARFOCUS_FEATURE_STREAMING;
  const test::Output whole = test::OutputOf(config, params, scene);
  CHECK(streamed.bytes == whole.bytes);
}

// With one view, ring buffers hold exactly the rows that blocks at layers 1 and 2 read.
TEST_CASE("stream: ring buffers hold all rows that layers need, up to the largest blur") {
  for (int radius = 1; radius <= 16; ++radius) {
    test::Scene scene = test::RandomScene(48, 200, 1, 0, float(radius), 70 + uint64_t(radius));
    for (float& disparity : scene.disparity) disparity = float(radius);
    test::Config config = test::ConfigFor(scene, radius);
    config.superblock = 32;
    starfocus::Params params =
        test::Params(0, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
    test::Output streamed(48, 200);
    test::Report report;
    const test::Output whole = test::OutputOf(config, params, scene, &report);
    CHECK(report.layers[radius < 3 ? 0 : radius < 6 ? 1 : 2].pixels == 48 * 200);
    config.features |= STARFOCUS_FEATURE_STREAMING;
    test::Engine engine(config);
    REQUIRE(test::Stream(&engine, params, scene, &streamed, 50, 50) == STARFOCUS_OK);
    CAPTURE(radius);
    CHECK(streamed.bytes == whole.bytes);
  }
}

}  // namespace
}  // namespace stream_bytes_test
