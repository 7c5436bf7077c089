// SPDX-License-Identifier: Apache-2.0
// Tests the fill of hidden surfaces that no captured view shows.
#include "lib/slices/inpaint.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/slices/layered_scene.h"

namespace inpaint_test {
namespace {

using test::kSize;

// Memory of InpaintHidden, filled with arbitrary values.
struct Memory {
  static constexpr size_t kStride = starfocus::FillStride(kSize), kGap = starfocus::kFillStep;
  std::vector<int16_t> disparity = std::vector<int16_t>(kSize * kStride + kGap, 99);
  std::vector<int16_t> rgb = std::vector<int16_t>(3 * kSize * kStride + kGap, 99);
  std::vector<int16_t> saved = std::vector<int16_t>(3 * (kGap + 1) * kStride + kGap, 99);
  std::vector<uint16_t> source = std::vector<uint16_t>(kSize * kStride, 99);
  std::vector<uint8_t> farthest = std::vector<uint8_t>(kSize, 99);
};

struct Scene : test::LayeredScene {
  explicit Scene(int views) : LayeredScene(views) {}

  void InpaintHidden() {
    Memory memory;
    starfocus::InpaintHidden(starfocus::simd::BestKernels(), 0,
                             {memory.disparity.data(), memory.rgb.data(), memory.saved.data(),
                              memory.source.data(), memory.farthest.data()},
                             &surfaces);
  }
};

// Makes a near square in front of a striped wall, with alternately three rows of level 0 and three
// rows of level 200.
Scene BeforeStripes(int views) {
  Scene scene(views);
  for (int y = 0; y < kSize; ++y) scene.Fill(0, kSize, y, y + 1, 0, y % 6 < 3 ? 0 : 200);
  scene.Fill(14, 30, 4, 36, 16, 90);
  return scene;
}

TEST_CASE("hidden fill: hidden pixels of a wall of one colour get exactly this colour") {
  Scene scene(1);
  scene.Fill(0, kSize, 0, kSize, -2, 137);
  scene.Fill(11, 31, 9, 29, 6, 20);
  scene.Find();
  const std::vector<int16_t> before = scene.colours[1];
  REQUIRE(scene.surfaces.repeats);
  scene.InpaintHidden();
  CHECK(scene.colours[1] == before);
  CHECK(scene.Colour(13, 20, 0) == 137);
}

TEST_CASE(
    "hidden fill: hidden pixels copy the wall at the edge, and the wall's mean farther away") {
  Scene scene = BeforeStripes(1);
  scene.Find();
  CHECK(scene.Colour(14, 19, 0) == 0);
  CHECK(scene.Colour(21, 19, 0) == 0);
  CHECK(scene.Colour(21, 22, 0) == 200);
  const std::vector<int16_t> seen = scene.colours[0];
  scene.InpaintHidden();
  CHECK(scene.colours[0] == seen);
  // Next to the edge, stripes continue. Seven pixels farther away, pixels have approximately the
  // mean level of the wall.
  CHECK(scene.Colour(14, 19, 0) <= 50);
  CHECK(scene.Colour(14, 22, 0) >= 150);
  for (int y = 18; y < 24; ++y) CHECK(std::abs(scene.Colour(21, y, 0) - 100) <= 40);
}

TEST_CASE("hidden fill: a single odd pixel beside an edge leaves no streak") {
  Scene scene(1);
  scene.Fill(0, kSize, 0, kSize, 0, 100);
  scene.Fill(0, 14, 20, 21, 0, 220);
  scene.Fill(14, 30, 4, 36, 16, 90);
  scene.Find();
  CHECK(scene.Colour(16, 20, 0) == 220);
  scene.InpaintHidden();
  for (int x = 14; x < 22; ++x) CHECK(scene.Colour(x, 20, 0) <= (x < 16 ? 130 : 115));
}

TEST_CASE("hidden fill: hidden pixels that captured views show do not change") {
  Scene scene = BeforeStripes(5);
  scene.Find();
  const std::vector<int16_t> colours = scene.colours[1];
  scene.InpaintHidden();
  int same = 0;
  for (int y = 12; y < 28; ++y) {
    const size_t at = scene.surfaces.At(15, y);
    same += scene.colours[1][at] == colours[at];
  }
  CHECK(same == 16);
}

TEST_CASE("hidden fill: surfaces of different disparities do not mix") {
  Scene scene(1);
  scene.Fill(0, 20, 0, kSize, -4, 30);
  scene.Fill(20, kSize, 0, kSize, -9, 220);
  scene.Fill(16, 24, 0, kSize, 8, 120);
  scene.Find();
  scene.InpaintHidden();
  CHECK(scene.Behind(16, 20) == -4);
  CHECK(scene.Colour(16, 20, 0) == 30);
  CHECK(scene.Behind(23, 20) == -9);
  CHECK(scene.Colour(23, 20, 0) == 220);
}

TEST_CASE("hidden fill: the far colour of a split boundary pixel continues") {
  Scene scene(1);
  scene.Fill(0, kSize, 0, kSize, 0, 50);
  scene.Fill(20, kSize, 0, kSize, 12, 250);
  scene.Fill(19, 20, 0, kSize, 0, 100);  // a mixture that shows a quarter of the near surface
  scene.Find();
  CHECK(scene.Colour(24, 20, 0) == 100);
  for (int y = 0; y < kSize; ++y) {
    const size_t at = scene.surfaces.At(19, y);
    scene.surfaces.hiding[y] |= uint64_t{1} << 19 / test::kStripColumns;
    scene.share[at] = starfocus::simd::kSliceWhole / 4;
    scene.surfaces.disparity[1][at] = 0;
    scene.surfaces.disparity[0][at] = 12 * 64;
    for (size_t c = 0; c < 3; ++c) {
      scene.surfaces.rgb[1][c * scene.surfaces.plane + at] = 50 << starfocus::kLightBits;
    }
  }
  scene.InpaintHidden();
  CHECK(scene.Colour(24, 20, 0) == 50);
  CHECK(scene.Colour(19, 20, 0) == 50);
}

TEST_CASE("hidden fill: the fill of a mirrored scene is mirrored") {
  test::Random random(7);
  Scene scene(1), mirrored(1), turned(1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool near = std::abs(x - 17) + std::abs(y - 22) < 12;
      const int grey = random.Int(0, 255), pixels = near ? 14 : -1;
      scene.Set(x, y, pixels, grey);
      mirrored.Set(kSize - 1 - x, y, pixels, grey);
      turned.Set(y, x, pixels, grey);
    }
  }
  for (Scene* each : {&scene, &mirrored, &turned}) {
    each->Find();
    each->InpaintHidden();
  }
  int hidden = 0;
  const auto light = [](const Scene& of, int x, int y) {
    return of.surfaces.rgb[1][of.surfaces.At(x, y)];
  };
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (scene.Behind(x, y) == -1000) continue;
      ++hidden;
      CHECK(light(scene, x, y) == light(mirrored, kSize - 1 - x, y));
      CHECK(light(scene, x, y) == light(turned, y, x));
    }
  }
  CHECK(hidden > 200);
}

}  // namespace
}  // namespace inpaint_test
