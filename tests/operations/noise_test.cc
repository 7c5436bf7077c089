// SPDX-License-Identifier: Apache-2.0
// Tests that noise of one code in the views does not decide how a picture is refocused: in mode
// frame, no pixel may change by much more than the noise. Also tests that inverted views give the
// inverted picture. In mode block, tiles of thin structure are still found by a limit, which a few
// pixels of this scene show.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace noise_test {
namespace {

constexpr int kWidth = 128, kHeight = 64, kStrands = 48;
constexpr double kWall = -11.4;

// A slanted strand in front of the wall: x = at + slope * y in the centre view.
struct Strand {
  double at, slope, radius, disparity;
  int rgb[3];
};

// Returns the part of a pixel that the strand covers, if the pixel is `distance` pixels from the
// middle of the strand.
double Covered(const Strand& strand, double distance) {
  const double right = std::min(distance + 0.5, strand.radius);
  const double left = std::max(distance - 0.5, -strand.radius);
  return std::max(0.0, right - left);
}

// Makes hair in front of a wall: strands of 0.4 to 3 pixels at disparities from 8 to 12. The pixels
// of all views are mixtures, and the map has the nearest surface at the middle of each pixel.
test::Scene HairScene() {
  test::Random random(9);
  std::vector<Strand> strands(kStrands);
  for (Strand& strand : strands) {
    strand = {random.Real(0, kWidth),
              random.Real(-0.6, 0.6),
              random.Real(0.2, 1.5),
              random.Real(8, 12),
              {}};
    for (int& value : strand.rgb) value = random.Int(10, 150);
  }
  std::sort(strands.begin(), strands.end(),
            [](const Strand& a, const Strand& b) { return a.disparity < b.disparity; });
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 5, -12, 13);
  for (int view = 0; view < scene.views(); ++view) {
    const starfocus_position at = scene.PositionOf(view);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double wall = x + at.u * kWall, row = y + at.v * kWall;
        double rgb[3];
        for (int c = 0; c < 3; ++c) rgb[c] = 150 + 60 * std::sin(0.31 * wall + 0.23 * row + c);
        double nearest = kWall;
        for (const Strand& strand : strands) {
          const double middle =
              strand.at + strand.slope * (y + at.v * strand.disparity - kHeight / 2);
          const double distance = x + at.u * strand.disparity - middle;
          const double covered = Covered(strand, distance);
          for (int c = 0; c < 3; ++c) rgb[c] += covered * (strand.rgb[c] - rgb[c]);
          if (std::fabs(distance) <= strand.radius) nearest = strand.disparity;
        }
        for (int c = 0; c < 3; ++c) scene.Pixel(view, x, y)[c] = uint8_t(std::lround(rgb[c]));
        if (view == 0) scene.Disparity(x, y) = float(nearest);
      }
    }
  }
  return scene;
}

// Applies change(value) to all samples of all views.
template <class Change>
test::Scene Changed(test::Scene scene, const Change& change) {
  for (std::vector<uint8_t>& picture : scene.pictures) {
    for (uint8_t& value : picture) value = uint8_t(std::clamp(change(int(value)), 0, 255));
  }
  return scene;
}

struct Way {
  starfocus_mode mode;
  starfocus_renderer renderer;
  double focus;
};
const Way kWays[] = {{STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, 10},
                     {STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_SLICES, kWall},
                     {STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN, 10},
                     {STARFOCUS_MODE_FRAME, STARFOCUS_RENDERER_LINE_SCAN, kWall}};

test::Output Refocused(const test::Scene& scene, const Way& way) {
  test::Config config = test::ConfigFor(scene);
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.features = STARFOCUS_FEATURE_COVERAGE;
  return test::OutputOf(config, test::Params(way.focus, 1, way.mode, way.renderer), scene);
}

// Returns the number of samples of two pictures that differ by more than `codes`.
int CountAbove(const test::Output& a, const test::Output& b, int codes) {
  int count = 0;
  for (size_t n = 0; n < a.bytes.size(); ++n) {
    count += std::abs(int(a.bytes[n]) - int(b.bytes[n])) > codes ? 1 : 0;
  }
  return count;
}

TEST_CASE("noise: one code of noise in the views changes no pixel by more than a few codes") {
  const test::Scene scene = HairScene();
  for (const Way& way : kWays) {
    if (way.mode != STARFOCUS_MODE_FRAME) continue;
    const test::Output plain = Refocused(scene, way);
    for (const uint64_t seed : {1, 2, 3}) {
      CAPTURE(way.mode);
      CAPTURE(way.focus);
      CAPTURE(seed);
      test::Random random(seed);
      const test::Scene noisy =
          Changed(scene, [&](int value) { return value + random.Int(-1, 1); });
      const test::Output changed = Refocused(noisy, way);
      CHECK(CountAbove(plain, changed, 8) == 0);
    }
  }
}

TEST_CASE("noise: inverted views give the inverted picture") {
  const test::Scene scene = HairScene();
  const test::Scene inverse = Changed(scene, [](int value) { return 255 - value; });
  for (const Way& way : kWays) {
    CAPTURE(way.mode);
    CAPTURE(way.focus);
    const test::Output plain = Refocused(scene, way);
    test::Output inverted = Refocused(inverse, way);
    for (uint8_t& value : inverted.bytes) value = uint8_t(255 - value);
    const bool frame = way.mode == STARFOCUS_MODE_FRAME;
    CHECK(CountAbove(plain, inverted, 1) <= (frame ? 0 : 30));
  }
}

}  // namespace
}  // namespace noise_test
