// SPDX-License-Identifier: Apache-2.0
// Compares checksums of estimated and repaired maps with recorded checksums, which every machine,
// SIMD target and compiler must reproduce. After an intended change of maps, the test states the
// new checksums.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/depth/depth_scene.h"

namespace map_golden_bytes_test {
namespace {

constexpr int kMargin = 8;
constexpr int kNear = 4, kFar = -2;

// A near plane with an uneven outline in front of a far plane, made with integer arithmetic. The
// pictures of other views show the planes at whole pixels. The near plane begins at least 20 pixels
// right of `left`.
struct IntegerPlanes {
  const int width, height, left;
  std::vector<uint8_t> texture[2] = {};

  IntegerPlanes(int w, int h, int l) : width(w), height(h), left(l) {
    test::Random random(7);
    for (std::vector<uint8_t>& samples : texture) {
      for (int n = 0; n < 3 * (width + 2 * kMargin) * (height + 2 * kMargin); ++n) {
        const int shade = n / 3 / 9 % 11 * 10;
        samples.push_back(uint8_t(shade + random.Int(0, &samples == texture ? 90 : 140)));
      }
    }
  }
  bool IsNear(int x, int y) const { return x - left >= 20 + y / 8 && x - left < 50 - y * y / 200; }

  uint8_t operator()(double u, double v, int x, int y, int c) const {
    const bool near = IsNear(x + int(u * kNear), y + int(v * kNear));
    const int column = x + int(u * (near ? kNear : kFar)), row = y + int(v * (near ? kNear : kFar));
    const int at = (row + kMargin) * (width + 2 * kMargin) + column + kMargin;
    return texture[near ? 0 : 1][size_t(3 * at + c)];
  }
};

// Returns a map with an outline that is two pixels too wide, steps of an eighth of a pixel, and
// unknown and wrong disparities.
std::vector<float> GivenMap(const IntegerPlanes& planes) {
  std::vector<float> map;
  for (int y = 0; y < planes.height; ++y) {
    for (int x = 0; x < planes.width; ++x) {
      const bool near = planes.IsNear(x - 2, y) || planes.IsNear(x + 2, y);
      map.push_back(float((near ? kNear : kFar) + (x + y) % 3 / 8.0));
      if (x > 30 && x < 36 && y > 20 && y < 24) map.back() = NAN;
      if (x > 60 && y > 40) map.back() = float(kNear);
    }
  }
  return map;
}

// Returns the FNV-1a checksum of the disparities, in 1/64 pixel, and of the confidence.
uint64_t Hash(const test::MadeMap& map) {
  uint64_t hash = 0xCBF29CE484222325u;
  const auto add = [&](int value) { hash = (hash ^ uint64_t(uint32_t(value))) * 0x100000001B3u; };
  for (const float disparity : map.disparity) add(int(std::floor(64 * double(disparity) + 0.5)));
  for (const uint8_t confidence : map.confidence) add(confidence);
  return hash;
}

struct Row {
  std::string name;
  std::vector<starfocus_position> positions;  // Empty: a star of `views` views.
  int views;
  bool repair;
  uint64_t hash;
  // Lengths of 400 pixels give three tiles, with an edge across a boundary of tiles.
  int width = 72, left = 0, height = 48;
};

TEST_CASE("map golden: maps match the recorded checksums on every machine and SIMD target") {
  const std::vector<starfocus_position> pair = {{0, 0}, {1, 0}};
  const std::vector<starfocus_position> anywhere = {{0, 0}, {1, 0.5}, {-0.5, 1}, {-1, -0.5}};
  const Row kRows[] = {
      {"estimate, 5 views", {}, 5, false, 0xCFDE98378712B8B5U},
      {"estimate, 9 views", {}, 9, false, 0x3B7E2433AD93270EU},
      {"estimate, 17 views", {}, 17, false, 0xE61AF8BAFA352F5BU},
      {"estimate, a pair", pair, 2, false, 0xEAE26E86230CA5EEU},
      {"estimate, 4 views anywhere", anywhere, 4, false, 0x138CF71E100B7252U},
      {"repair, 1 view", {}, 1, true, 0x6AE351DB2E8BC8AAU},
      {"repair, 5 views", {}, 5, true, 0xB888B16522B416B6U},
      {"repair, 17 views", {}, 17, true, 0x8E0B216A1F4D6760U},
      {"repair, 1 view, 3 rows of tiles", {}, 1, true, 0xCE2F4D00AC427D67U, 72, 0, 400},
      {"repair, 1 view, 3 tiles", {}, 1, true, 0xDC147EEEB660E2E3U, 400, 110},
      {"repair, 5 views, 3 tiles", {}, 5, true, 0xF08328215A52F0E2U, 400, 110},
      // Fewer pixels than a vector, and narrower than a patch.
      {"estimate, 5 views, one row", {}, 5, false, 0x2C7864A7611DD0C7U, 33, 0, 1},
      {"repair, 9 views, one column", {}, 9, true, 0x57D91FDB7DC63D5DU, 1, -20, 30},
      {"repair, 5 views, small", {}, 5, true, 0xBF0F082DB5E89B75U, 17, -12, 9},
  };
  for (const Row& row : kRows) {
    const IntegerPlanes planes(row.width, row.height, row.left);
    const test::PlaneField field =
        test::RenderViews(row.width, row.height, row.views, planes, row.positions);
    const test::MadeMap map = test::MakeMap(field, test::ConfigOf(field, -6, 8),
                                            row.repair ? GivenMap(planes) : std::vector<float>());
    CAPTURE(row.name);
    CHECK(Hash(map) == row.hash);
  }
}

}  // namespace
}  // namespace map_golden_bytes_test
