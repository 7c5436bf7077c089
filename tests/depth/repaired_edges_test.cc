// SPDX-License-Identifier: Apache-2.0
// Tests the outlines of repaired maps. Where edges of the picture are soft, the outline of the near
// surface must move outwards to include the mixed pixels. Outlines in the repaired map must not be
// more ragged than the edges in the picture.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "lib/depth/outlines.h"

namespace repaired_edges_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr int16_t kNear = 12 << starfocus::kDisparityBits, kFar = 0;

// A picture with a dark near half and a bright far half. The edge in the map may be at another
// column in each row.
struct Scene {
  std::vector<uint8_t> rgb = std::vector<uint8_t>(3 * kWidth * kHeight);
  std::vector<int16_t> map = std::vector<int16_t>(kWidth * kHeight);
  starfocus::SweepSetup setup = {};
  starfocus_light_field field = {};

  Scene() {
    setup.width = kWidth;
    setup.height = kHeight;
    field.views[0] = starfocus_image_rgb(rgb.data(), 3 * kWidth);
  }
  starfocus::ColourMap Map() const { return {setup, field, map.data()}; }
  // Fills the picture and the map with a near half and a far half. The edge in the picture is a
  // ramp of `ramp` pixels that begins at the given column.
  template <class Column>
  void Fill(double ramp, const Column& edge_of_map, int edge_of_picture) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double far = std::clamp((x + 0.5 - edge_of_picture) / ramp, 0.0, 1.0);
        const size_t at = size_t(y) * kWidth + size_t(x);
        for (size_t c = 0; c < 3; ++c) rgb[3 * at + c] = uint8_t(std::lround(40 + 160 * far));
        map[at] = x < edge_of_map(y) ? kNear : kFar;
      }
    }
  }
};

int Softness(const Scene& scene) {
  starfocus::SoftCount counts[2] = {};
  starfocus::CountSoft(scene.Map(), {0, 0, kWidth / 2, kHeight}, &counts[0]);
  starfocus::CountSoft(scene.Map(), {kWidth / 2, 0, kWidth / 2, kHeight}, &counts[1]);
  CHECK(counts[0].edges + counts[1].edges > kHeight / 2);
  return starfocus::SoftnessOf(counts, 2);
}

TEST_CASE("repaired edges: SoftnessOf returns the width of soft edges, at most kMostSoft pixels") {
  Scene scene;
  const auto straight = [](int) { return 48; };
  scene.Fill(1, straight, 48);
  CHECK(Softness(scene) == 0);
  scene.Fill(2, straight, 48);
  CHECK(Softness(scene) == 2);
  scene.Fill(4, straight, 48);
  CHECK(Softness(scene) == starfocus::kMostSoft);
  // SoftnessOf returns 0 for a map without edges. CountSoft counts no edges in a picture without
  // contrast.
  const starfocus::SoftCount none = {};
  CHECK(starfocus::SoftnessOf(&none, 1) == 0);
  std::fill(scene.rgb.begin(), scene.rgb.end(), uint8_t{90});
  starfocus::SoftCount flat = {};
  starfocus::CountSoft(scene.Map(), {0, 0, kWidth, kHeight}, &flat);
  CHECK(flat.edges == 0);
}

TEST_CASE("repaired edges: a pixel that shows a part of the nearer surface becomes near") {
  Scene scene;
  scene.Fill(
      3, [](int) { return 48; }, 48);
  const auto widened = [&](int x, int y) {
    return starfocus::WidenedAt(scene.Map(), starfocus::kMostSoft, x, y);
  };
  for (const int y : {8, 31, 50}) {
    CHECK(widened(47, y) == kNear);
    CHECK(widened(48, y) == kNear);  // The near surface covers 5/6 of the pixel.
    CHECK(widened(49, y) == kNear);  // The near surface covers half of the pixel.
    CHECK(widened(50, y) == kNear);  // The near surface covers 1/6 of the pixel.
    CHECK(widened(51, y) == kFar);
  }
  CHECK(starfocus::WidenedAt(scene.Map(), 1, 49, 31) == kFar);
  scene.Fill(
      1, [](int) { return 48; }, 48);
  CHECK(widened(49, 31) == kFar);
}

TEST_CASE("repaired edges: TakeMajority moves displaced rows back to the edge of the picture") {
  Scene scene;
  scene.Fill(
      1, [](int y) { return 48 + (y * 7 + y / 3) % 5 - 2; }, 48);
  int moved = 0, left = 0;
  for (int y = 5; y < kHeight - 5; ++y) {
    int16_t even[starfocus::kMostMajority];
    starfocus::TakeMajority(scene.Map(), {32, y, 32, 1}, even);
    for (int x = 32; x < 64; ++x) {
      const int16_t right = x < 48 ? kNear : kFar;
      moved += scene.map[size_t(y) * kWidth + size_t(x)] != right;
      left += even[x - 32] != right;
    }
  }
  CHECK(moved > 50);
  CHECK(left == 0);
}

TEST_CASE("repaired edges: a pixel alone between two surfaces joins one; two pixels stay") {
  for (const int length : {1, 2}) {
    Scene scene;
    scene.Fill(
        1, [](int) { return 48; }, 48);
    const int16_t between = kNear * 5 / 8;
    for (int y = 30; y < 30 + length; ++y) scene.map[size_t(y) * kWidth + 47] = between;
    int16_t row[32];
    starfocus::TakeMajority(scene.Map(), {32, 30, 32, 1}, row);
    CHECK(row[15] == (length == 1 ? kNear : between));
  }
}

TEST_CASE("repaired edges: MedianOfSurface ignores other surfaces and small differences") {
  Scene scene;
  scene.Fill(
      1, [](int) { return 48; }, 48);
  const auto set = [&](int x, int y, int below) {
    scene.map[size_t(y) * kWidth + size_t(x)] = int16_t(kNear - below);
  };
  const int quarter = 1 << (starfocus::kDisparityBits - 2);
  set(47, 20, quarter + 1);
  set(47, 30, quarter);
  CHECK(starfocus::MedianOfSurface(scene.Map(), 47, 20) == kNear);
  CHECK(starfocus::MedianOfSurface(scene.Map(), 47, 30) == kNear - quarter);
}

}  // namespace
}  // namespace repaired_edges_test
