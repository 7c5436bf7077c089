// SPDX-License-Identifier: Apache-2.0
// Tests the separation of mixed pixels: the last bit of a colour never decides whether a pixel is
// split, and inverted colours are split into equal shares. Tests that the search for surfaces finds
// the same pixels as a search of all pixels, and that rims behind defocused surfaces do not remain
// sharp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>
#include <vector>

#include "lib/matting/coverage_tile.h"
#include "lib/matting/mixed_pixels.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace matting_test {
namespace {

using starfocus::BoundaryColours;
using starfocus::Colour;
using starfocus::Found;
using starfocus::GivenDisparities;
using starfocus::Mixture;
using starfocus::SurfaceSearch;
using starfocus::Unmix;

constexpr int kCode = 1 << 7, kWhite = 255 * kCode;
constexpr double kShareOne = 1 << starfocus::kShareBits;

// Draws two colours and a colour near the line between them. Half of the colours are at the limits
// of contrast, share and distance from the line.
BoundaryColours Draw(test::Random* random) {
  BoundaryColours colours;
  const int contrast = random->Int(0, 1) == 0 ? 255 : random->Int(4, 20);
  const double share = random->Real(-0.1, 1.1), beside = random->Real(0, 0.4) * contrast + 3;
  for (int c = 0; c < 3; ++c) {
    const int far = random->Int(0, 255 - contrast);
    const int near = far + random->Int(0, contrast);
    const double mixed = share * near + (1 - share) * far + random->Real(-beside, beside);
    colours.far.rgb[c] = int16_t(far * kCode);
    colours.near.rgb[c] = int16_t(near * kCode);
    colours.mixed.rgb[c] = int16_t(std::clamp(int(mixed * kCode), 0, kWhite));
  }
  return colours;
}

Colour Changed(const Colour& colour, int most, test::Random* random) {
  Colour changed = colour;
  for (int16_t& value : changed.rgb) {
    value = int16_t(std::clamp(value + random->Int(-most, most), 0, kWhite));
  }
  return changed;
}

Colour Inverted(const Colour& colour) {
  Colour inverted = colour;
  for (int16_t& value : inverted.rgb) value = int16_t(kWhite - value);
  return inverted;
}

// Returns the largest difference, in codes, of the light that the near surface contributes, or of
// the far colour.
double Step(const BoundaryColours& colours, const Mixture& a, const Mixture& b) {
  double step = 0;
  for (int c = 0; c < 3; ++c) {
    const double contrast = colours.near[c] - colours.far[c];
    const double near = (a.share - b.share) / kShareOne * contrast, far = a.far[c] - b.far[c];
    step = std::max({step, std::fabs(near) / kCode, std::fabs(far) / kCode});
  }
  return step;
}

TEST_CASE("boundary pixels: a sixteenth of a code changes light by less than three codes") {
  test::Random random(16);
  double most = 0;
  int split = 0;
  for (int n = 0; n < 200000; ++n) {
    const BoundaryColours colours = Draw(&random);
    const BoundaryColours changed = {Changed(colours.near, kCode / 16, &random),
                                     Changed(colours.far, kCode / 16, &random),
                                     Changed(colours.mixed, kCode / 16, &random)};
    const Mixture before = Unmix(colours, starfocus::kContrastFade, colours),
                  after = Unmix(changed, starfocus::kContrastFade, changed);
    most = std::max(most, Step(colours, before, after));
    split += before.share > 0 ? 1 : 0;
  }
  CHECK(most < 3);
  CHECK(split > 20000);
}

TEST_CASE("boundary pixels: inverted colours have equal shares and inverted far colours") {
  test::Random random(17);
  for (int n = 0; n < 20000; ++n) {
    const BoundaryColours colours = Draw(&random);
    const Mixture plain = Unmix(colours, starfocus::kContrastFade, colours);
    const BoundaryColours other = {Inverted(colours.near), Inverted(colours.far),
                                   Inverted(colours.mixed)};
    const Mixture inverted = Unmix(other, starfocus::kContrastFade, other);
    CHECK(inverted.share == plain.share);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(kWhite - inverted.far[c] - plain.far[c]) <= 1);
  }
}

TEST_CASE("boundary pixels: a pixel that shows one surface keeps its colour") {
  const Colour near = {{200 * kCode, 180 * kCode, 190 * kCode}}, far = {{20 * kCode, 0, 9 * kCode}};
  const Colour other = {{20 * kCode, 200 * kCode, 9 * kCode}};
  for (const BoundaryColours& colours :
       {BoundaryColours{near, far, near}, BoundaryColours{near, far, other},
        BoundaryColours{near, near, near}, BoundaryColours{near, far, far}}) {
    const Mixture mixture = Unmix(colours, starfocus::kContrastFade, colours);
    CHECK(mixture.share == 0);
    for (int c = 0; c < 3; ++c) CHECK(mixture.far[c] == colours.mixed[c]);
  }
}

// --- Search for surfaces ---

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
std::vector<int16_t> Picture(int32_t count, test::Random* random) {
  std::vector<int16_t> picture(kSide * kSide, 0);
  for (int32_t k = 0; k < count; ++k) {
    const int32_t x = random->Int(0, kSide - 1), y = random->Int(0, kSide - 1);
    const auto disparity = int16_t(random->Int(-1000, 1000));
    for (int32_t i = 0; i < 4; ++i) {
      picture[size_t(y * kSide + std::min(x + i, kSide - 1))] = int16_t(disparity + k % 2 * 64 * i);
    }
  }
  return picture;
}

TEST_CASE("surface search: finds the nearest pixel, and prefers the same among equally near") {
  test::Random random(1);
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

// --- Rims of surfaces behind an edge, in pictures with one view ---

constexpr int kWidth = 64, kHeight = 48, kEdge = 32;

// Makes a dark near surface on the right in front of a grey one, with one view. The far columns
// next to the edge have the greys of `rim`, beginning at the edge, in rows for which is_rim(y) is
// true.
template <class IsRim>
test::Scene Rimmed(const std::vector<int>& rim, const IsRim& is_rim) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 1, 0, 6);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int away = kEdge - 1 - x;
      const bool in_rim = away >= 0 && away < int(rim.size()) && is_rim(y);
      const int grey = away < 0 ? 20 : in_rim ? rim[size_t(away)] : 120;
      scene.Disparity(x, y) = away < 0 ? 6 : 0;
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(grey));
    }
  }
  return scene;
}

test::Scene Rimmed(const std::vector<int>& rim) {
  return Rimmed(rim, [](int) { return true; });
}

std::vector<int> MiddleRow(const test::Scene& scene, double focus) {
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = config.tuning.max_layer = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  const test::Output out =
      test::OutputOf(config, test::Params(focus, 1, STARFOCUS_MODE_BLOCK), scene);
  std::vector<int> row;
  for (int x = 0; x < kWidth; ++x) row.push_back(*out.Pixel(x, kHeight / 2));
  return row;
}

TEST_CASE("rims: with one view, no contaminated rim remains sharp behind a defocused surface") {
  const std::vector<int> clean = MiddleRow(Rimmed({}), 0);
  const std::vector<int> rims[] = {{150, 150}, {120, 150, 140}, {150, 145, 140, 135}, {70, 104}};
  for (const std::vector<int>& rim : rims) {
    const std::vector<int> row = MiddleRow(Rimmed(rim), 0);
    for (int x = kEdge - 10; x < kEdge + 10; ++x) {
      CAPTURES(rim[0], x);
      CHECK(std::abs(row[size_t(x)] - clean[size_t(x)]) <= 16);
      CHECK(std::abs(row[size_t(x)] - row[size_t(x - 1)]) <= 20);
    }
  }
}

TEST_CASE("rims: with one view, a halo stays beside a sharp surface") {
  const std::vector<int> row = MiddleRow(Rimmed({150, 150}), 6);
  CHECK(row[kEdge - 1] >= 140);
  CHECK(row[kEdge - 2] >= 140);
  CHECK(row[kEdge - 5] <= 125);
}

TEST_CASE("rims: with one view, neither texture nor a gradient beside an edge is a rim") {
  const int middle = kHeight / 2;
  const auto is_texture = [](int y) { return y % 5 == 4; };
  REQUIRE(is_texture(middle));
  CHECK(MiddleRow(Rimmed({180, 180}, is_texture), 0)[kEdge - 2] >= 130);
  const std::vector<int> gradient = {148, 144, 140, 136, 132, 128, 124, 120, 116};
  const std::vector<int> row = MiddleRow(Rimmed(gradient), 0), flat = MiddleRow(Rimmed({}), 0);
  for (int away = 0; away < 4; ++away) {
    const auto x = size_t(kEdge - 1 - away);
    CAPTURE(away);
    CHECK(2 * (row[x] - flat[x]) >= gradient[size_t(away)] - 120);
  }
}

}  // namespace
}  // namespace matting_test
