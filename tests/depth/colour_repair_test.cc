// SPDX-License-Identifier: Apache-2.0
// Repairs maps of one view by the colours of the view: correct disparities are kept, and displaced
// edges are moved back.
#include "lib/depth/colour_repair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <vector>

#include "lib/base/fixed.h"
#include "starfocus/starfocus.hpp"
#include "tests/depth/depth_scene.h"
#include "tests/depth/disc_photo.h"
#include "tests/support/config.h"
#include "tests/support/test_scene.h"

namespace colour_repair_test {
namespace {

using starfocus::kDisparityBits;
using test::MakeDisc;
using test::Photo;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Repaired {
  std::vector<float> map;
  std::vector<uint8_t> confidence;
};

starfocus::SweepSetup SetupOf(const Photo& photo) {
  test::Config config;
  config.width = photo.width;
  config.height = photo.height;
  config.disparity_min = -500;
  config.disparity_max = 500;
  return starfocus::MakeSetup(config, true);
}

starfocus_light_field FieldOf(const Photo& photo) {
  starfocus_light_field field = starfocus::NewLightField();
  const auto width = size_t(photo.width);
  field.views[0] = starfocus_image_rgb(photo.rgb.data(), 3 * width);
  field.depth =
      starfocus_depth_float(photo.map.data(), width * sizeof(float), photo.width, photo.height);
  return field;
}

Repaired Repair(const Photo& photo) {
  const starfocus::SweepSetup setup = SetupOf(photo);
  starfocus::Arena counted(nullptr);
  TakeColourRepair(setup, 1, &counted);
  const test::Memory base(counted.Bytes());
  starfocus::Arena arena(base.data);
  const starfocus::ColourMemory memory = TakeColourRepair(setup, 1, &arena);
  const auto width = size_t(photo.width);
  Repaired result = {std::vector<float>(photo.map.size()), std::vector<uint8_t>(photo.map.size())};
  const starfocus::MapOutput output = {
      {result.map.data(), width}, -500, 500, {result.confidence.data(), width}, {}};
  bool has_coverage = false;
  CHECK(RepairByColour(setup, FieldOf(photo), starfocus::simd::BestDepthKernels(), output, memory,
                       &has_coverage) == STARFOCUS_OK);
  return result;
}

bool SameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

// Counts the pixels that have the disparity of the wrong surface. Disparities of one surface differ
// by at most 1.02 pixels.
int CountWrong(const std::vector<float>& map, const Photo& truth) {
  int wrong = 0;
  for (size_t k = 0; k < map.size(); ++k) wrong += std::abs(map[k] - truth.map[k]) > 1.02F;
  return wrong;
}

TEST_CASE("colour repair: a map edge that is 3 pixels off moves back to the edge of the picture") {
  const Photo truth = MakeDisc(0);
  for (const int grown : {3, -3}) {
    const Photo photo = MakeDisc(grown);
    CAPTURE(grown);
    CHECK(CountWrong(photo.map, truth) > 600);
    CHECK(CountWrong(Repair(photo).map, truth) < 8);
  }
}

TEST_CASE("colour repair: a ramp of disparity between two surfaces becomes a step") {
  const Photo truth = MakeDisc(0);
  Photo photo = truth;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double inside = (46 - std::hypot(x - 151.3, y - 66.2)) / 12;
      photo.Map(x, y) = float(-4 + 10 * std::clamp(inside, 0.0, 1.0));
    }
  }
  CHECK(CountWrong(photo.map, truth) > 1800);
  CHECK(CountWrong(Repair(photo).map, truth) < 20);
}

// Returns the map at a quarter of its size and interpolated bilinearly to full size, as network
// maps are enlarged.
std::vector<float> Enlarged(const Photo& photo) {
  const int columns = photo.width / 4, rows = photo.height / 4;
  std::vector<float> small(size_t(columns) * size_t(rows)), map;
  for (int y = 0; y < 4 * rows; ++y) {
    for (int x = 0; x < 4 * columns; ++x) {
      small[size_t(y / 4 * columns + x / 4)] += photo.map[photo.At(x, y)] / 16;
    }
  }
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const float u = std::clamp((float(x) - 1.5F) / 4, 0.0F, float(columns - 1));
      const float v = std::clamp((float(y) - 1.5F) / 4, 0.0F, float(rows - 1));
      const int left = std::min(int(u), columns - 2), top = std::min(int(v), rows - 2);
      const float* at = small.data() + top * columns + left;
      const float right = u - float(left), down = v - float(top);
      map.push_back((at[0] * (1 - right) + at[1] * right) * (1 - down) +
                    (at[columns] * (1 - right) + at[columns + 1] * right) * down);
    }
  }
  return map;
}

TEST_CASE("colour repair: no pixel within a surface keeps a part of the ramp of an enlarged map") {
  const Photo truth = MakeDisc(0, 12, -4);
  Photo photo = truth;
  photo.map = Enlarged(truth);
  const std::vector<float> map = Repair(photo).map;
  int lower = 0;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const float d = map[photo.At(x, y)];
      lower += std::hypot(x - 151.3, y - 66.2) < 38 && d < 11.25F;
    }
  }
  CHECK(lower == 0);
}

TEST_CASE("colour repair: pixels of a soft edge that show mostly the near surface become near") {
  Photo photo = MakeDisc(-3);
  const Photo wall = MakeDisc(-50), sharp = MakeDisc(0);
  const auto distance = [](int x, int y) { return std::hypot(x - 151.3, y - 66.2); };
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      const double far = std::clamp((distance(x, y) - 38) / 6, 0.0, 1.0);
      if (far == 0 || far == 1) continue;
      const uint8_t* behind = wall.rgb.data() + 3 * wall.At(x, y);
      const double near[] = {198, 88, 40};
      int mixed[3];
      for (int c = 0; c < 3; ++c)
        mixed[c] = int(std::lround(near[c] * (1 - far) + behind[c] * far));
      photo.Paint(x, y, mixed[0], mixed[1], mixed[2]);
    }
  }
  const Repaired repaired = Repair(photo);
  int mixed = 0, taken = 0;
  for (int y = 0; y < photo.height; ++y) {
    for (int x = 0; x < photo.width; ++x) {
      // Checks only pixels of which the near surface covers 5/8 to 19/24.
      if (distance(x, y) < 39.25 || distance(x, y) > 40.25) continue;
      ++mixed;
      taken += repaired.map[photo.At(x, y)] > 0;
    }
  }
  CHECK(taken > mixed * 9 / 10);
}

TEST_CASE("colour repair: a ragged outline becomes more correct even if the colours are noisy") {
  const Photo truth = MakeDisc(0);
  Photo photo = truth;
  test::Random random(9);
  for (int y = 0; y < photo.height; ++y) {
    const int by = random.Int(-2, 2);
    for (int x = 0; x < photo.width; ++x) {
      photo.Map(x, y) = truth.map[truth.At(std::clamp(x + by, 0, photo.width - 1), y)];
      const bool near = truth.map[truth.At(x, y)] > 0;
      const int noise = random.Int(-45, 45);
      photo.Paint(x, y, (near ? 150 : 100) + noise, 100 + random.Int(-25, 25), near ? 90 : 130);
    }
  }
  // Colours are noisy, so a repair that decides about each pixel alone would increase the error.
  CHECK(CountWrong(photo.map, truth) > 150);
  CHECK(CountWrong(Repair(photo).map, truth) < CountWrong(photo.map, truth));
}

TEST_CASE("colour repair: no bit of a correct map with steps, planes and fractions changes") {
  const Photo disc = MakeDisc(0, 6.0123F, -3.987F);
  CHECK(SameBits(Repair(disc).map, disc.map));
  Photo plane = MakeDisc(0);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) plane.Map(x, y) = 0.013F * float(x) - 0.07F * float(y);
  }
  CHECK(SameBits(Repair(plane).map, plane.map));
}

TEST_CASE(
    "colour repair: for a picture of one colour, only the outline may change and has low "
    "confidence") {
  Photo photo = MakeDisc(0);
  std::fill(photo.rgb.begin(), photo.rgb.end(), uint8_t{77});
  const Repaired repaired = Repair(photo);
  // Wrong pixels may occur only along the outline of the disc.
  CHECK(CountWrong(repaired.map, photo) < 60);
  CHECK(repaired.confidence[photo.At(5, 5)] == 255);
  CHECK(repaired.confidence[photo.At(151, 26)] < 100);
}

TEST_CASE("colour repair: noise of the map is averaged within each surface") {
  const Photo truth = MakeDisc(0);
  Photo photo = truth;
  AddNoise(&photo);
  const Repaired repaired = Repair(photo);
  double before = 0, after = 0;
  for (size_t k = 0; k < truth.map.size(); ++k) {
    before += std::pow(photo.map[k] - truth.map[k], 2);
    after += std::pow(repaired.map[k] - truth.map[k], 2);
  }
  CHECK(after < before / 20);
}

TEST_CASE(
    "colour repair: an unknown pixel gets the disparity of the surface with the same colour") {
  const Photo truth = MakeDisc(0);
  Photo photo = truth;
  for (int y = 20; y < 40; ++y) {
    for (int x = 130; x < 150; ++x) {
      photo.Map(x, y) = x % 3 == 0 ? kNan : x % 3 == 1 ? kInfinity : -kInfinity;
    }
  }
  const Repaired repaired = Repair(photo);
  CHECK(CountWrong(repaired.map, truth) < 8);
  for (const float d : repaired.map) CHECK(std::isfinite(d));
}

TEST_CASE("colour repair: a map with one known pixel gets the disparity of this pixel everywhere") {
  for (const int at : {0, 17, 34}) {
    Photo photo(7, 5);
    std::fill(photo.map.begin(), photo.map.end(), kNan);
    photo.map[size_t(at)] = 2.5F;
    for (const float d : Repair(photo).map) CHECK(d == 2.5F);
  }
}

TEST_CASE("colour repair: a row without known values is a copy of the nearest known row") {
  Photo photo(2, 8);
  std::fill(photo.map.begin(), photo.map.end(), kNan);
  photo.Map(0, 2) = 1, photo.Map(1, 2) = 4;
  photo.Map(0, 6) = 3, photo.Map(1, 6) = 2;
  std::vector<int16_t> filled(photo.map.size());
  const starfocus::SweepSetup setup = SetupOf(photo);
  starfocus::ReadRows(setup, FieldOf(photo), {0, photo.height}, filled.data());
  starfocus::FillUnknownRows(setup, filled.data());
  // A row that is equally near to two known rows gets the farther surface.
  const int expected[] = {1, 4, 1, 4, 1, 4, 1, 4, 1, 2, 3, 2, 3, 2, 3, 2};
  for (size_t k = 0; k < filled.size(); ++k) CHECK(filled[k] == expected[k] << kDisparityBits);
}

TEST_CASE("colour repair: pictures of a few pixels are repaired") {
  for (const int width : {1, 2, 3, 5, 16, 33}) {
    for (const int height : {1, 2, 4, 17}) {
      Photo photo(width, height);
      for (size_t k = 0; k < photo.map.size(); ++k) {
        photo.map[k] = float(int(k * k % 23) - 11) * 45.0F;
        photo.rgb[3 * k] = uint8_t(k * 37);
      }
      for (const float d : Repair(photo).map) CHECK(std::abs(d) <= 500);
    }
  }
}

}  // namespace
}  // namespace colour_repair_test
