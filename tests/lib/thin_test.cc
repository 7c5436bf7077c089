// SPDX-License-Identifier: Apache-2.0
// Tests thin structures: strands thinner than a pixel in front of a wall. The disparity map has the
// disparity of the surface at the centre of each pixel.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace thin_test {
namespace {

constexpr int kWidth = 160, kHeight = 144;
constexpr double kNear = 6, kFar = -6;
constexpr double kThick = 0.9;  // thickness of a strand in pixels

// Returns the part of the pixel at (x, y) of the centre view that strands cover. The strands, in
// the middle rows of the picture, lean to both sides.
double CoverageAt(double x, double y) {
  double left = 1;
  for (int k = 0; k < 24; ++k) {
    const double lean = k % 2 == 0 ? 0.23 : -0.31, at = 44 + 3 * k + lean * (y - kHeight / 2.0);
    if (std::abs(y - kHeight / 2.0) > 44) continue;
    const double beside = std::abs(x - at) / std::sqrt(1 + lean * lean);
    left *= 1 - std::clamp((1 + kThick) / 2 - beside, 0.0, std::min(1.0, kThick));
  }
  return 1 - left;
}

// WallAt returns the light of a bright wall with large soft waves. StrandAt returns the light of
// dark strands.
double WallAt(double x, double y, int c) {
  return 170 + 12 * c + 25 * std::sin(x / 19 + c) + 20 * std::cos(y / 23);
}
double StrandAt(int c) { return 60 - 12 * c; }

// Returns the light of a pixel that passes the lens at (u, v), if the lens is focused at the
// disparity `focus`.
double LightAt(int x, int y, int c, double u, double v, double focus) {
  const double near_x = x + u * (kNear - focus), near_y = y + v * (kNear - focus);
  const double far_x = x + u * (kFar - focus), far_y = y + v * (kFar - focus);
  const double coverage = CoverageAt(near_x, near_y);
  return coverage * StrandAt(c) + (1 - coverage) * WallAt(far_x, far_y, c);
}

test::Scene Strands(int views) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, views, float(kFar), float(kNear));
  for (int view = 0; view < views; ++view) {
    const starfocus_position at = scene.PositionOf(view);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        for (int c = 0; c < 3; ++c) {
          scene.Pixel(view, x, y)[c] = uint8_t(std::lround(LightAt(x, y, c, at.u, at.v, 0)));
        }
        if (view == 0) scene.Disparity(x, y) = float(CoverageAt(x, y) > 0.5 ? kNear : kFar);
      }
    }
  }
  return scene;
}

test::Config ConfigFor(const test::Scene& scene, bool coverage) {
  test::Config config = test::ConfigFor(scene, kNear - kFar);
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.superblock = 64;
  if (!coverage) config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  return config;
}

// Returns parameters for block mode with a disc as the opening.
starfocus::Params ThroughDisc(double focus) {
  starfocus::Params params = test::Params(focus, 1, STARFOCUS_MODE_BLOCK);
  params.shape = STARFOCUS_SHAPE_DISC;
  return params;
}

// Returns the expected picture: the mean of LightAt over positions in a disc.
std::vector<double> TruthOf(double focus) {
  std::vector<double> truth(3 * kWidth * kHeight, 0.0);
  constexpr int kSteps = 7;
  double count = 0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      if (i * i + j * j > kSteps * kSteps) continue;
      ++count;
      for (size_t n = 0; n < truth.size(); ++n) {
        const int x = int(n / 3 % kWidth), y = int(n / 3 / kWidth);
        truth[n] += LightAt(x, y, int(n % 3), i / double(kSteps), j / double(kSteps), focus);
      }
    }
  }
  for (double& value : truth) value /= count;
  return truth;
}

// Returns the PSNR in dB of the inner part of the picture; near the rim, the views lack data.
double PsnrOf(const test::Output& out, const std::vector<double>& truth) {
  double sum = 0, count = 0;
  for (int y = 16; y < kHeight - 16; ++y) {
    for (int x = 16; x < kWidth - 16; ++x) {
      for (int c = 0; c < 3; ++c, ++count) {
        const double error = out.Pixel(x, y)[c] - truth[size_t(3 * (y * kWidth + x) + c)];
        sum += error * error;
      }
    }
  }
  return 10 * std::log10(255 * 255 * count / sum);
}

}  // namespace

TEST_CASE(
    "thin: with coverage, the PSNR of strands in front of a sharp or blurred wall is higher") {
  for (const double focus : {kFar, kNear}) {
    const std::vector<double> truth = TruthOf(focus);
    for (const int views : {1, 5}) {
      const test::Scene scene = Strands(views);
      const starfocus::Params params = ThroughDisc(focus);
      const double with = PsnrOf(test::OutputOf(ConfigFor(scene, true), params, scene), truth);
      const double without = PsnrOf(test::OutputOf(ConfigFor(scene, false), params, scene), truth);
      MESSAGE("views ", views, ", focus ", focus, ": PSNR without and with coverage ", without,
              " and ", with, " dB");
      CHECK(with > without + 2);
    }
  }
}

TEST_CASE("thin: all ways to refocus return the same bytes") {
  const test::Scene scene = Strands(5);
  test::Config config = ConfigFor(scene, true);
  for (const double focus : {kFar, 0.0, kNear}) {
    CAPTURE(focus);
    starfocus::Params params = ThroughDisc(focus);
    const test::Output whole = test::CheckWays(scene, config, params);
    config.tuning.line_scan = nullptr;
    CHECK((test::OutputOf(config, params, scene).bytes == whole.Tight()));
  }
}

TEST_CASE("thin: noise of one code changes no pixel by more than 8 codes") {
  for (const int views : {1, 5}) {
    // From right to left, the wall gets the colour of the strands. With the grain of the pixels,
    // colours lie on both sides of every limit.
    test::Scene scene = Strands(views), noisy = scene;
    test::Random random(18);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (scene.Disparity(x, y) > 0) scene.Disparity(x, y) += float(random.Real(-0.5, 0));
        noisy.Disparity(x, y) = scene.Disparity(x, y);
        for (int view = 0; view < views; ++view) {
          const double grain = random.Real(-25, 25);
          for (int c = 0; c < 3; ++c) {
            uint8_t& code = scene.Pixel(view, x, y)[c];
            code = uint8_t(std::lround(StrandAt(c) + (code - StrandAt(c)) * x / kWidth + grain));
            noisy.Pixel(view, x, y)[c] = uint8_t(code + std::lround(random.Real(-1.5, 1.5)));
          }
        }
      }
    }
    for (const double focus : {kFar, 0.0, kNear}) {
      const starfocus::Params params = ThroughDisc(focus);
      const test::Output before = test::OutputOf(ConfigFor(scene, true), params, scene);
      const test::Output after = test::OutputOf(ConfigFor(scene, true), params, noisy);
      int most = 0;
      for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
          for (int c = 0; c < 3; ++c) {
            most = std::max(most, std::abs(before.Pixel(x, y)[c] - after.Pixel(x, y)[c]));
          }
        }
      }
      MESSAGE("views ", views, ", focus ", focus, ": largest change ", most);
      CHECK(most <= 8);
    }
  }
}

}  // namespace thin_test
