// SPDX-License-Identifier: Apache-2.0
// Tests the continuation of surfaces beyond the picture. If side views show the scene beyond the
// picture, a refocused picture must equal the same part of a larger picture of the scene. Surfaces
// that a nearer surface covers must not be used.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "lib/io/block_pixels.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/star_views.h"
#include "tests/support/test_scene.h"

namespace picture_edge_test {
namespace {

constexpr int kSide = 96;

// Makes a scene whose views show a pattern at one disparity. Pixel (0, 0) of the centre view shows
// (x0, y0) of the pattern.
test::Scene FlatScene(int x0, int y0, int side, int views, float disparity) {
  test::Scene scene = test::EmptyScene(side, side, views, disparity - 1, disparity + 1);
  for (int view = 0; view < views; ++view) {
    double u = 0, v = 0;
    starfocus_view_position(view, &u, &v, nullptr);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        // View (u, v) shows pixel (x, y) of the centre view at (x - u d, y - v d).
        const double px = x0 + x + u * double(disparity), py = y0 + y + v * double(disparity);
        for (int c = 0; c < 3; ++c) {
          const double wave = std::sin(0.23 * px + c) * std::cos(0.19 * py - c) + 0.004 * (px + py);
          scene.Pixel(view, x, y)[c] = uint8_t(std::lround(110 + 75 * wave));
        }
      }
    }
  }
  for (float& d : scene.disparity) d = disparity;
  return scene;
}

struct Difference {
  int largest;
  double mean;
};

// Compares the picture with the same part of a larger picture, near the edges but not near the
// corners.
Difference AtEdges(const test::Refocused& picture, const test::Refocused& larger, int margin) {
  constexpr int kFrame = 6, kCorner = 16;
  Difference difference = {0, 0};
  int count = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const bool beside_x = x < kFrame || x >= kSide - kFrame;
      const bool beside_y = y < kFrame || y >= kSide - kFrame;
      const bool corner =
          (x < kCorner || x >= kSide - kCorner) && (y < kCorner || y >= kSide - kCorner);
      if (corner || !(beside_x || beside_y)) continue;
      for (int c = 0; c < 3; ++c) {
        const size_t at = size_t(3 * (y * kSide + x) + c);
        const size_t there = size_t(3 * ((y + margin) * (kSide + 2 * margin) + x + margin) + c);
        const int apart = std::abs(picture.rgb[at] - larger.rgb[there]);
        difference.largest = std::max(difference.largest, apart);
        difference.mean += apart;
        ++count;
      }
    }
  }
  difference.mean /= count;
  return difference;
}

TEST_CASE("picture edge: refocused pixels at the edges match a larger picture of the scene") {
  constexpr int kMargin = 32;
  for (const int views : {5, 9, 17}) {
    for (const float disparity : {-9.0f, 9.0f, 10.5f}) {
      const test::Scene scene = FlatScene(0, 0, kSide, views, disparity);
      const test::Scene larger =
          FlatScene(-kMargin, -kMargin, kSide + 2 * kMargin, views, disparity);
      for (const starfocus_mode mode :
           {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
        for (const int gather : {0, 1}) {
          test::Config config = test::ConfigFor(scene, 9);
          config.tuning.gather = gather;
          config.transfer = STARFOCUS_TRANSFER_NONE;
          test::Config larger_config = test::ConfigFor(larger, 9);
          larger_config.tuning.gather = gather;
          larger_config.transfer = STARFOCUS_TRANSFER_NONE;
          const starfocus::Params params = test::Params(double(disparity) - 8, 1, mode);
          const Difference difference =
              AtEdges(test::RefocusScene(scene, config, params),
                      test::RefocusScene(larger, larger_config, params), kMargin);
          CAPTURES(views, disparity, mode, gather);
          CHECK(difference.largest <= 4);
          CHECK(difference.mean < 0.75);
        }
      }
    }
  }
}

TEST_CASE("picture edge: with one view, the edge pixels are repeated") {
  constexpr int kMargin = 32;
  const test::Scene scene = FlatScene(0, 0, kSide, 1, 9);
  const test::Scene larger = FlatScene(-kMargin, -kMargin, kSide + 2 * kMargin, 1, 9);
  const starfocus::Params params = test::Params(1, 1, STARFOCUS_MODE_BLOCK);
  const auto refocused = [&](const test::Scene& one) {
    test::Config config = test::ConfigFor(one, 9);
    config.transfer = STARFOCUS_TRANSFER_NONE;
    return test::RefocusScene(one, config, params);
  };
  CHECK(AtEdges(refocused(scene), refocused(larger), kMargin).mean > 3);
}

// --- One row of a light field ---

constexpr int kWidth = 64, kHeight = 8, kBorder = 12;

struct Row {
  // The centre view has red level x at pixel x. Side view v has level 100 + v everywhere.
  explicit Row(int views) : side(size_t(views)) {
    for (size_t view = 0; view < side.size(); ++view) {
      side[view].assign(3 * kWidth * kHeight, uint8_t(100 + view));
      test::SetPixels(int(view), side[view], 3 * kWidth, &input);
    }
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) side[0][size_t(3 * (y * kWidth + x))] = uint8_t(x);
    }
    input.width = kWidth;
    input.height = kHeight;
    test::SetStar(views, &input);
    input.transfer = &starfocus::TransferOf(STARFOCUS_TRANSFER_NONE);
    disparity.assign(kWidth * kHeight, 0);
    input.disparity = {disparity.data(), kWidth, 0, 0};
  }
  Row(const Row&) = delete;

  void Fill(int begin, int end, int unit) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = begin; x < end; ++x) disparity[size_t(y * kWidth + x)] = int16_t(64 * unit);
    }
  }

  // Returns the red samples of a row, including kBorder pixels on the left and kBorder pixels on
  // the right of the picture.
  std::vector<int> Load() {
    const int width = kWidth + 2 * kBorder;
    std::vector<int16_t> rgb(starfocus::RgbStride(width) * kHeight);
    std::vector<int16_t> copy(size_t(width) * kHeight);
    starfocus::BlockPixels field;
    field.rgb = rgb.data();
    field.disparity = copy.data();
    starfocus::LoadBlock(input, 0, {0, 0, kWidth, kHeight}, {kBorder, kBorder, 0, 0}, &field);
    std::vector<int> row;
    for (int x = 0; x < width; ++x) row.push_back(*field.Rgb(x, 3) >> starfocus::kLightBits);
    return row;
  }

  std::vector<std::vector<uint8_t>> side;
  std::vector<int16_t> disparity;
  starfocus::Input input;
};

TEST_CASE("picture edge: pixels beyond an edge are read from the side view that shows them") {
  for (const int views : {5, 9, 17}) {
    for (const int unit : {-5, 5}) {
      Row scene(views);
      scene.Fill(0, kWidth, unit);
      // View 1 is at (1, 0), and view 2 is at (-1, 0). A view at u shows pixel k beyond the left
      // edge at -k - u d.
      const int left = unit < 0 ? 1 : 2, right = 3 - left;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < 5; ++x) {
          scene.side[size_t(left)][size_t(3 * (y * kWidth + x))] = uint8_t(200 + x);
          scene.side[size_t(right)][size_t(3 * (y * kWidth + kWidth - 1 - x))] = uint8_t(200 + x);
        }
      }
      const std::vector<int> row = scene.Load();
      for (int k = 1; k <= kBorder; ++k) {
        CAPTURES(views, unit, k);
        const int seen = 200 + std::max(5 - k, 0);
        CHECK(row[size_t(kBorder - k)] == seen);
        CHECK(row[size_t(kBorder + kWidth - 1 + k)] == seen);
      }
      CHECK(row[kBorder] == 0);
      CHECK(row[kBorder + kWidth - 1] == kWidth - 1);
    }
  }
}

TEST_CASE("picture edge: with a pair, pixels beyond one edge are read from the second view") {
  for (const int unit : {-10, 10}) {
    Row scene(17);
    test::SetPositions({{0.5, 0}}, &scene.input);
    scene.Fill(0, kWidth, unit);
    const std::vector<int> row = scene.Load();
    for (int k = 1; k <= kBorder; ++k) {
      CAPTURES(unit, k);
      CHECK(row[size_t(kBorder - k)] == (unit < 0 ? 101 : 0));
      CHECK(row[size_t(kBorder + kWidth - 1 + k)] == (unit > 0 ? 101 : kWidth - 1));
    }
  }
}

TEST_CASE("picture edge: pixels beyond an edge that a nearer surface covers are not read") {
  Row scene(5);
  scene.Fill(0, kWidth, -6);
  // In view (1, 0), a surface that is nearer by 7 covers pixels 1 to 3 beyond the edge.
  scene.Fill(4, 7, 1);
  std::vector<int> row = scene.Load();
  for (int k = 0; k <= kBorder; ++k) CHECK(row[size_t(kBorder - k)] == 0);
  scene.Fill(3, 7, -6);
  scene.Fill(2, 4, 1);  // the near surface covers pixels 4 and 5 beyond the edge
  row = scene.Load();
  CHECK(row[kBorder] == 0);
  for (int k = 1; k <= kBorder; ++k) CHECK(row[size_t(kBorder - k)] == 101);
  for (int y = 0; y < kHeight; ++y) {
    // View 1 shows pixel 4 beyond the edge at position 2, and pixel 3 at position 3.
    scene.side[1][size_t(3 * (y * kWidth + 2))] = 7;
    scene.side[1][size_t(3 * (y * kWidth + 3))] = 9;
  }
  row = scene.Load();
  CHECK(row[kBorder - 2] == 101);
  for (int k = 3; k <= kBorder; ++k) CHECK(row[size_t(kBorder - k)] == 9);
}

TEST_CASE("picture edge: a near surface that moves inwards hides no pixels beyond the edge") {
  Row scene(5);
  scene.Fill(0, kWidth, 3);
  scene.Fill(1, 20, 9);
  const std::vector<int> row = scene.Load();
  for (int k = 1; k <= kBorder; ++k) CHECK(row[size_t(kBorder - k)] == 102);
}

}  // namespace
}  // namespace picture_edge_test
