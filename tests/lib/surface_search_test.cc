// SPDX-License-Identifier: Apache-2.0
// Tests that the search for surfaces finds the same pixels as a search of all pixels.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <vector>

#include "lib/matting/coverage_tile.h"

namespace surface_search_test {
namespace {

using starfocus::Found;
using starfocus::GivenDisparities;
using starfocus::SurfaceSearch;
constexpr int32_t kSide = GivenDisparities::kSide, kReach = starfocus::kGivenRadius;

// Reads all pixels within kReach columns and rows.
Found Expected(const GivenDisparities& around, const SurfaceSearch& search, int32_t at, int32_t low,
               int32_t high) {
  std::tuple<int32_t, int32_t, int32_t> best(INT32_MAX, 0, 0);  // squared distance, square, index
  for (int32_t dy = -kReach; dy <= kReach; ++dy) {
    for (int32_t dx = -kReach; dx <= kReach; ++dx) {
      const int32_t there = at + dy * kSide + dx, disparity = around.disparity[there];
      if (search.IsOnRamp(there) || disparity < low || disparity > high) continue;
      best = std::min(best, {dx * dx + dy * dy, std::max(std::abs(dx), std::abs(dy)), there});
    }
  }
  const bool found = std::get<0>(best) != INT32_MAX;
  return {around.disparity[found ? std::get<2>(best) : at], std::get<0>(best)};
}

// Returns a picture with `count` random surfaces of a few pixels in front of a wall. Every second
// surface is a ramp.
std::vector<int16_t> Picture(int32_t count, std::mt19937* random) {
  std::vector<int16_t> picture(kSide * kSide, 0);
  for (int32_t k = 0; k < count; ++k) {
    const auto x = int32_t((*random)() % kSide), y = int32_t((*random)() % kSide);
    const auto disparity = int16_t(int32_t((*random)() % 2001) - 1000);
    for (int32_t i = 0; i < 4; ++i) {
      picture[size_t(y * kSide + std::min(x + i, kSide - 1))] = int16_t(disparity + k % 2 * 64 * i);
    }
  }
  return picture;
}

TEST_CASE("surface search: finds the nearest pixel, and prefers the same among equally near") {
  std::mt19937 random(1);
  for (const int32_t surfaces : {0, 1, 3, 12, 200, 2000}) {
    CAPTURE(surfaces);
    const std::vector<int16_t> picture = Picture(surfaces, &random);
    starfocus::Input input;
    input.width = input.height = kSide;
    input.disparity = {picture.data(), kSide};
    const GivenDisparities around(input, 2, 2);
    const SurfaceSearch search(around);
    for (int32_t y = 0; y < starfocus::kCoverageTile; ++y) {
      for (int32_t x = 0; x < starfocus::kCoverageTile; ++x) {
        const int32_t at = GivenDisparities::At(x, y), here = around.disparity[at];
        for (const bool nearer : {false, true}) {
          const int32_t low = nearer ? here + 97 : INT16_MIN, high = nearer ? INT16_MAX : here - 97;
          const Found found = search.FindNearest(at, low, high),
                      expected = Expected(around, search, at, low, high);
          REQUIRE(found.distance == expected.distance);
          REQUIRE(found.disparity == expected.disparity);
        }
      }
    }
  }
}

}  // namespace
}  // namespace surface_search_test
