// SPDX-License-Identifier: Apache-2.0
// Tests the coverage that a repair of one view finds if the map has closed the outline of hair.
#include "lib/matting/hair_coverage.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "starfocus/depth.h"
#include "starfocus/starfocus.hpp"
#include "tests/depth/depth_scene.h"
#include "tests/support/closed_hair.h"
#include "tests/support/config.h"

namespace hair_coverage_test {
namespace {

using test::Area;
using test::MakeClosedHair;
using Portrait = test::ClosedHair;

constexpr float kNear = Portrait::kNear, kFar = Portrait::kFar;

struct Found {
  starfocus_status status;
  int32_t has_coverage;
  std::vector<float> map;
  std::vector<uint8_t> confidence, coverage;
};

Found Repair(const Portrait& portrait, bool covers = true) {
  const test::PlaneField plane = {Portrait::kWidth, Portrait::kHeight, {portrait.rgb}};
  const test::Config config = test::ConfigOf(plane, -12, 12);
  size_t bytes = 0;
  REQUIRE(starfocus_map_workspace_size(&config, 1, &bytes, nullptr) == STARFOCUS_OK);
  const test::Memory memory(bytes);
  const size_t width = Portrait::kWidth, row = sizeof(float) * width, pixels = portrait.map.size();
  starfocus_light_field field = plane.Get();
  field.depth = starfocus_depth_float(portrait.map.data(), row, plane.width, plane.height);
  Found found = {STARFOCUS_OK, 0, std::vector<float>(pixels, NAN), std::vector<uint8_t>(pixels, 77),
                 std::vector<uint8_t>(pixels, 77)};
  starfocus_disparity_output map = {
      found.map.data(), row, found.confidence.data(), width, nullptr, width, -1};
  if (covers) map.coverage = found.coverage.data();
  found.status =
      starfocus_repair_disparity(&config, nullptr, &field, &map, memory.data, bytes, nullptr);
  found.has_coverage = map.has_coverage;
  return found;
}

// Returns the mean absolute difference of two planes in an area.
double Difference(const Area& area, const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  int64_t sum = 0, count = 0;
  for (int y = area.top; y < area.bottom; ++y) {
    for (int x = area.left; x < area.right; ++x, ++count) {
      const size_t at = size_t(y) * Portrait::kWidth + size_t(x);
      sum += std::abs(a[at] - b[at]);
    }
  }
  return double(sum) / double(count);
}

TEST_CASE("hair coverage: a repair finds coverage where the map has closed the outline of hair") {
  const Portrait portrait = MakeClosedHair();
  const Found found = Repair(portrait);
  REQUIRE(found.status == STARFOCUS_OK);
  REQUIRE(found.has_coverage == 1);
  // The map alone implies a coverage of 255 everywhere in the hair, with a mean error of 182.
  CHECK(Difference({44, 64, 176, 108}, found.coverage, portrait.coverage) < 24);
  CHECK(Difference({60, 124, 232, 178}, found.coverage, portrait.coverage) < 0.5);
  CHECK(Difference({60, 30, 160, 56}, found.coverage, portrait.coverage) < 4);
  // The repair must not change any disparity of the hair.
  for (int y = 64; y < 106; ++y) {
    for (int x = 44; x < 176; ++x) REQUIRE(found.map[portrait.At(x, y)] == kNear);
  }
}

TEST_CASE("hair coverage: confidence is high where map and coverage agree") {
  const Portrait portrait = MakeClosedHair();
  const Found found = Repair(portrait);
  REQUIRE(found.has_coverage == 1);
  for (int y = 70; y < 100; ++y) {
    for (int x = 60; x < 160; ++x) {
      const size_t at = portrait.At(x, y);
      // In the rows and columns of this loop, all pixels of the map are near.
      REQUIRE(found.confidence[at] == found.coverage[at]);
    }
  }
}

TEST_CASE("hair coverage: outlines without hair are repaired even near hair, and stay opaque") {
  Portrait portrait = MakeClosedHair();
  // The map is changed so that the top edge of the body to the right of the hair is 2 pixels too
  // low.
  for (int y = 110; y < 112; ++y) {
    for (int x = 182; x < 240; ++x) portrait.map[portrait.At(x, y)] = kFar;
  }
  const Found found = Repair(portrait);
  REQUIRE(found.has_coverage == 1);
  for (int y = 110; y < 112; ++y) {
    for (int x = 232; x < 238; ++x) {
      CHECK(found.map[portrait.At(x, y)] == kNear);
      CHECK(found.coverage[portrait.At(x, y)] == 255);
    }
  }
  CHECK(found.coverage[portrait.At(234, 108)] == 0);
}

TEST_CASE(
    "hair coverage: without hair, a request finds no coverage and changes neither map nor "
    "confidence") {
  Portrait portrait;
  portrait.Draw();
  for (size_t k = 0; k < portrait.map.size(); k += 7) portrait.map[k] += 0.01F;
  const Found asked = Repair(portrait), unasked = Repair(portrait, false);
  CHECK(asked.has_coverage == 0);
  CHECK(unasked.has_coverage == 0);
  CHECK(asked.map == unasked.map);
  CHECK(asked.confidence == unasked.confidence);
  for (const uint8_t value : unasked.coverage) REQUIRE(value == 77);
}

TEST_CASE("hair coverage: hair is found in its place, and outlines elsewhere stay opaque") {
  Portrait portrait = MakeClosedHair();
  portrait.hair = {0, 60, 70, 110};
  portrait.body = {0, 110, 240, 181};
  portrait.post = {170, 10, 220, 110};
  portrait.Draw();
  const Found found = Repair(portrait);
  REQUIRE(found.has_coverage == 1);
  CHECK(Difference({4, 64, 66, 106}, found.coverage, portrait.coverage) < 24);
  CHECK(Difference({140, 14, 240, 181}, found.coverage, portrait.coverage) == 0);
}

TEST_CASE("hair coverage: the texture of the wall does not get coverage") {
  Portrait portrait = MakeClosedHair();
  portrait.spots = true;
  portrait.Draw();
  const Found found = Repair(portrait);
  REQUIRE(found.has_coverage == 1);
  CHECK(Difference({60, 40, 160, 56}, found.coverage, portrait.coverage) < 0.5);
}

TEST_CASE("hair coverage: a pattern of the wall that the map covers is not taken for hair") {
  Portrait portrait;
  portrait.strands.period = 1;  // The strands cover nothing.
  portrait.spots = true;
  portrait.spot_share = 100;
  portrait.spot_period = 7;
  portrait.body = {};
  portrait.Draw();
  CHECK(Repair(portrait).has_coverage == 0);
}

TEST_CASE("hair coverage: a map without edges has no coverage") {
  Portrait portrait = MakeClosedHair();
  portrait.map.assign(portrait.map.size(), kNear);
  CHECK(Repair(portrait).has_coverage == 0);
}

TEST_CASE(
    "hair coverage: hair across the picture gets coverage, and rows without hair are opaque") {
  Portrait portrait = MakeClosedHair();
  portrait.hair = {0, 60, 240, 110};
  portrait.body = {0, 110, 240, 181};
  portrait.Draw();
  const Found found = Repair(portrait);
  REQUIRE(found.has_coverage == 1);
  CHECK(Difference({0, 64, 240, 108}, found.coverage, portrait.coverage) < 60);
  for (int x = 0; x < Portrait::kWidth; ++x) {
    REQUIRE(found.coverage[portrait.At(x, 112)] == 255);
    REQUIRE(found.coverage[portrait.At(x, 5)] == 255);
  }
}

// Owns a colour pyramid that has no known colours.
struct PyramidOf {
  PyramidOf(int width, int height) : memory(SizeOf(width, height)) {
    starfocus::Arena arena(memory.data);
    pyramid = starfocus::TakeColourPyramid(width, height, &arena);
    for (int y = 0; y < pyramid.rows; ++y) {
      for (int x = 0; x < pyramid.columns; ++x) pyramid.At(0, x, y) = {};
    }
  }
  static size_t SizeOf(int width, int height) {
    starfocus::Arena arena(nullptr);
    starfocus::TakeColourPyramid(width, height, &arena);
    return arena.Bytes();
  }

  test::Memory memory;
  starfocus::ColourPyramid pyramid;
};

TEST_CASE("colour pyramid: known colours stay, and unknown colours are interpolated") {
  PyramidOf made(101, 37);
  const starfocus::ColourPyramid& pyramid = made.pyramid;
  CHECK_FALSE(starfocus::CarryOnColours(pyramid));
  const starfocus::ColourMean left = {{64, 640, 6400}, 256}, right = {{6400, 640, 64}, 256};
  for (int y = 0; y < pyramid.rows; ++y) {
    pyramid.At(0, 0, y) = left;
    pyramid.At(0, 25, y) = right;
  }
  REQUIRE(starfocus::CarryOnColours(pyramid));
  for (int y = 0; y < pyramid.rows; ++y) {
    for (int x = 0; x <= 25; ++x) {
      const starfocus::ColourMean& mean = pyramid.At(0, x, y);
      if (x == 0) CHECK(mean.rgb[0] == 64);
      if (x == 25) CHECK(mean.rgb[0] == 6400);
      CHECK(std::abs(mean.rgb[1] - 640) <= 2);
      CHECK(std::abs(mean.rgb[0] + mean.rgb[2] - 6464) <= 4);
      if (x > 0) CHECK(mean.rgb[0] >= pyramid.At(0, x - 1, y).rgb[0]);
    }
  }
}

TEST_CASE("colour pyramid: interpolation of a linear gradient is exact") {
  PyramidOf made(40, 40);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      made.pyramid.At(0, x, y) = {{uint16_t(800 * x), uint16_t(800 * y), 16320},
                                  starfocus::kFullyKnown};
    }
  }
  for (int y = 28; y < 32; ++y) {
    for (int x = 16; x < 20; ++x) {
      int32_t rgb[3];
      starfocus::ColourAt(made.pyramid, x, y, rgb);
      CHECK(rgb[0] == 200 * x - 300);
      CHECK(rgb[1] == 200 * y - 300);
      CHECK(rgb[2] == 16320);
    }
  }
}

}  // namespace
}  // namespace hair_coverage_test
