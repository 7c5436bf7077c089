// SPDX-License-Identifier: Apache-2.0
// Tests that the separation of boundary pixels is continuous: the last bit of a colour never
// decides whether a pixel is split. Also tests that inverted colours are split into equal shares.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/matting/mixed_pixels.h"
#include "tests/support/test_scene.h"

namespace boundary_pixel_test {
namespace {

using starfocus::BoundaryColours;
using starfocus::Colour;
using starfocus::Mixture;
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

}  // namespace
}  // namespace boundary_pixel_test
