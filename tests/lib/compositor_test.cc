// SPDX-License-Identifier: Apache-2.0
// Tests the composited picture of a stack of slices in cases with a known result.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/simd_targets.h"
#include "tests/support/test_scene.h"

namespace compositor_test {
namespace {

constexpr int kWidth = 96, kHeight = 64, kEdge = 48;

// Makes a scene that is white and near on the left, and black and far on the right. All side views
// are black, except for the 20 columns at the left edge, which are white.
test::Scene HalfPlanes(double near, double far, int views) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, views, float(far), float(near));
  for (auto& picture : scene.pictures) std::fill(picture.begin(), picture.end(), uint8_t{0});
  for (int y = 0; y < kHeight; ++y) {
    for (int view = 1; view < views; ++view)
      std::fill_n(scene.Pixel(view, 0, y), 3 * 20, uint8_t(255));
    for (int x = 0; x < kWidth; ++x) {
      scene.Disparity(x, y) = float(x < kEdge ? near : far);
      if (x < kEdge) std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(255));
    }
  }
  return scene;
}

std::vector<int> MiddleRow(const test::Scene& scene, double focus, starfocus_mode mode,
                           int layers = 0) {
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.tuning.max_layer = layers;
  starfocus::Params params = test::Params(focus, 1, mode, STARFOCUS_RENDERER_SLICES);
  const test::Refocused picture = test::RefocusScene(scene, config, params);
  std::vector<int> row;
  for (int x = 0; x < kWidth; ++x) {
    row.push_back(picture.rgb[size_t(3 * (kHeight / 2 * kWidth + x))]);
  }
  return row;
}

TEST_CASE("stack: a surface in focus has a sharp end in front of a blurred surface") {
  for (const int views : {5, 9, 17}) {
    for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
      const std::vector<int> row = MiddleRow(HalfPlanes(2, -6, views), 2, mode);
      CAPTURE(views);
      for (int x = 0; x < kWidth; ++x) {
        CAPTURE(x);
        CHECK(row[size_t(x)] == (x < kEdge ? 255 : 0));
      }
    }
  }
}

TEST_CASE("stack: a blurred surface fades evenly in front of a surface in focus") {
  for (const double radius : {2.0, 6.0, 13.0, 20.0}) {
    const std::vector<int> row = MiddleRow(HalfPlanes(radius - 3, -3, 5), -3, STARFOCUS_MODE_BLOCK);
    CAPTURE(radius);
    for (int x = 1; x < kWidth; ++x) {
      CAPTURE(x);
      CHECK(row[size_t(x)] <= row[size_t(x - 1)]);
      // The transition has no bands, since a subaperture is at most a sixth as wide as the blur,
      // except for sharp surfaces.
      if (radius > 3) CHECK(row[size_t(x - 1)] - row[size_t(x)] <= 300 / radius);
      if (x < kEdge - radius - 2) CHECK(row[size_t(x)] == 255);
      if (x > kEdge + radius + 2) CHECK(row[size_t(x)] == 0);
    }
    // At the edge, half of the light is white.
    CHECK(std::abs(row[kEdge - 1] + row[kEdge] - 255) <= 6);
  }
}

TEST_CASE("stack: captured views show the far surface behind a blurred surface") {
  test::Scene scene = HalfPlanes(4, 0, 5);
  for (int view = 1; view < 5; ++view) {
    std::fill(scene.pictures[size_t(view)].begin(), scene.pictures[size_t(view)].end(),
              uint8_t(100));
  }
  const std::vector<int> row = MiddleRow(scene, 0, STARFOCUS_MODE_BLOCK);
  // Grey is visible where the near surface covers a part of the lens. Farther to the right, the far
  // surface is black.
  CHECK(row[kEdge - 1] > 150);
  CHECK(row[kEdge - 4] > row[kEdge - 1]);
  CHECK(row[kEdge + 6] == 0);
}

TEST_CASE("stack: adjacent slices of one slope leave no gaps and do not cover each other") {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 5, -3, 8);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      scene.Disparity(x, y) = -3 + 11.0f * float(x) / kWidth;
      // Blur does not change a ramp of levels.
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(2 * x));
    }
  }
  for (const double focus : {-3.0, 0.0, 8.0}) {
    const std::vector<int> row = MiddleRow(scene, focus, STARFOCUS_MODE_BLOCK);
    for (int x = 16; x < kWidth - 16; ++x) {
      CAPTURES(focus, x);
      CHECK(std::abs(row[size_t(x)] - 2 * x) <= 1);
    }
  }
}

TEST_CASE("stack: the end of a slope covers the same share where slices overlap as elsewhere") {
  test::Scene scene = HalfPlanes(7, 0, 5);
  test::SetDisparity(&scene, [&](int x, int y) {
    return x < kEdge ? 3 + float(y) / kHeight : scene.Disparity(x, y);
  });
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.tuning.max_layer = 0;
  const test::Refocused picture =
      test::RefocusScene(scene, config, test::Params(0, 1, STARFOCUS_MODE_BLOCK));
  double least = kWidth, most = 0;
  for (int y = 8; y < kHeight - 8; ++y) {
    double light = 0;
    for (int x = 0; x < kWidth; ++x) light += picture.rgb[size_t(3 * (y * kWidth + x))] / 255.0;
    least = std::min(least, light);
    most = std::max(most, light);
  }
  CAPTURES(least, most);
  CHECK(std::abs(least - kEdge) < 0.06);
  CHECK(std::abs(most - kEdge) < 0.06);
}

TEST_CASE("stack: slices that are computed in several parts give the same picture") {
  test::Random random(4);
  test::Scene scene = HalfPlanes(9, -9, 5);
  for (auto& picture : scene.pictures) {
    for (uint8_t& sample : picture) sample = uint8_t(random.Int(0, 255));
  }
  test::Engine engine(test::ConfigFor(scene, 20));
  size_t& pool = test::PoolBytes(engine.get());
  const auto reach = size_t(starfocus::SliceReach(16 * starfocus::kShiftOne, starfocus::kShiftOne));
  const size_t whole = starfocus::SliceBytes(64, 64, reach) + starfocus::StripBytes(64, reach);
  const size_t least = starfocus::SliceBytes(16, 8, reach) + starfocus::StripBytes(8, reach);
  REQUIRE(pool > 2 * whole);
  for (const double focus : {0.0, 6.0}) {
    const starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BENCHMARK);
    test::Output out(kWidth, kHeight);
    const test::Output expected = test::OutputOf(&engine, params, scene);
    const size_t ample = pool;
    for (const size_t bytes : {whole, (whole + least) / 2, 2 * least}) {
      pool = bytes;
      REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
      CAPTURES(focus, bytes);
      CHECK(out.bytes == expected.bytes);
    }
    pool = ample;
  }
}

int rows_filled = 0;

// Cancels the call as soon as the first row of a slice has been filled.
int SayNo(void*, int32_t, int32_t) { return rows_filled > 0 ? 1 : 0; }

TEST_CASE("stack: no more buckets are computed after cancellation") {
  const test::Scene scene = test::RandomScene(256, 256, 5, -3, 9, 8);
  test::Config config = test::ConfigFor(scene, 32);
  config.superblock = 256;
  test::Engine engine(config);
  starfocus::simd::Kernels counting = starfocus::simd::BestKernels();
  counting.SelectSlice = [](auto... arguments) {
    ++rows_filled;
    return starfocus::simd::BestKernels().SelectSlice(arguments...);
  };
  test::UseKernels(&counting, engine.get());
  starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_SLICES);
  test::Output out = test::OutputOf(&engine, params, scene);
  const int all = rows_filled;
  rows_filled = 0;
  CHECK(test::Refocus(&engine, params, scene, &out, test::ToldTo(SayNo)) ==
        STARFOCUS_ERROR_CANCELLED);
  CHECK(rows_filled > 0);
  CHECK(rows_filled < all / 8);  // fewer than two of sixteen buckets were computed
}

// With AddressSanitizer, red zones between the parts of a workspace increase its size.
TEST_CASE("stack: a worker requires 1.15 MiB for blocks of 64 pixels and blurs of up to 32 pixels" *
          doctest::skip(starfocus::kRedZone > 0)) {
  size_t bytes[2];
  for (int workers = 1; workers <= 2; ++workers) {
    test::Config config = test::ConfigFor(HalfPlanes(16, -16, 17), 32);
    config.superblock = 64;
    config.max_workers = workers;
    REQUIRE(starfocus_workspace_size(&config, &bytes[workers - 1], nullptr) == STARFOCUS_OK);
  }
  CHECK(bytes[1] - bytes[0] <= size_t{1180} << 10);
}

}  // namespace
}  // namespace compositor_test
