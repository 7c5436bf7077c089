// SPDX-License-Identifier: Apache-2.0
// Tests the boundary pixels of slices in a picture with one depth edge.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace matte_test {
namespace {

constexpr int kWidth = 64, kHeight = 48, kEdge = 32;
constexpr int kNear = 240, kFar = 40;

// Makes a scene that is near on the right and far on the left. The far column next to the edge
// shows a quarter of the near surface. Captured views show the far surface everywhere.
test::Scene Mixed(double near, double far, int views, bool transposed = false, int mixed = 90) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, views, float(std::min(near, far)),
                                       float(std::max(near, far)));
  for (auto& picture : scene.pictures) std::fill(picture.begin(), picture.end(), uint8_t(kFar));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int along = transposed ? y + 8 : x;
      scene.Disparity(x, y) = float(along >= kEdge ? near : far);
      const int grey = along >= kEdge ? kNear : along == kEdge - 1 ? mixed : kFar;
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(grey));
    }
  }
  return scene;
}

std::vector<int> MiddleRow(const test::Scene& scene, double focus, bool transposed = false,
                           double aperture = 1) {
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.tuning.max_layer = 0;
  const test::Refocused picture =
      test::RefocusScene(scene, config, test::Params(focus, aperture, STARFOCUS_MODE_BLOCK));
  std::vector<int> row;
  for (int k = 0; k < (transposed ? kHeight : kWidth); ++k) {
    const int x = transposed ? kWidth / 2 : k, y = transposed ? k : kHeight / 2;
    row.push_back(picture.rgb[size_t(3 * (y * kWidth + x))]);
  }
  return row;
}

TEST_CASE("matte: a mixed pixel does not change while both surfaces are sharp") {
  for (const int views : {5, 9, 17}) {
    const std::vector<int> row = MiddleRow(Mixed(1, 0, views), 0.5);
    CAPTURE(views);
    CHECK(std::abs(row[kEdge - 1] - 90) <= 12);
    CHECK(row[kEdge - 3] == kFar);
    CHECK(row[kEdge + 2] == kNear);
  }
}

TEST_CASE("matte: a defocused surface ends a quarter of a pixel farther out, without an outline") {
  for (const bool transposed : {false, true}) {
    const int edge = transposed ? kEdge - 8 : kEdge;
    const std::vector<int> mixed = MiddleRow(Mixed(6, 0, 5, transposed), 0, transposed);
    const std::vector<int> pure = MiddleRow(Mixed(6, 0, 5, transposed, kFar), 0, transposed);
    int light = 0;
    for (size_t k = 0; k < mixed.size(); ++k) light += mixed[k] - pure[k];
    CAPTURE(transposed);
    // The mixed column adds a quarter of a pixel of the near surface's light, spread over the blur.
    CHECK(std::abs(light - (kNear - kFar) / 4) <= 12);
    for (int k = edge - 5; k < edge + 5; ++k) {
      CHECK(mixed[size_t(k)] - pure[size_t(k)] >= 0);
      CHECK(mixed[size_t(k)] - pure[size_t(k)] <= 12);
    }
  }
}

TEST_CASE("matte: a defocused background contains no light of a sharp surface") {
  // With one view, the far colour is read from the neighbouring pixel.
  for (const int views : {1, 5}) {
    const std::vector<int> row = MiddleRow(Mixed(0, -6, views), 0);
    CAPTURE(views);
    // The mixed pixel still shows a quarter of the sharp surface.
    CHECK(std::abs(row[kEdge - 1] - 90) <= 1);
    for (int x = 4; x < kEdge - 1; ++x) CHECK(row[size_t(x)] == kFar);
    for (int x = kEdge; x < kWidth - 4; ++x) CHECK(row[size_t(x)] == kNear);
  }
}

// Makes a dark surface on the right in front of a grey one, with one view. The far columns next to
// the edge have the greys of `rim`, beginning at the edge, in rows for which is_rim(y) is true.
template <class IsRim>
test::Scene Rimmed(const std::vector<int>& rim, const IsRim& is_rim) {
  test::Scene scene = Mixed(6, 0, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int away = kEdge - 1 - x;
      const bool in_rim = away >= 0 && away < int(rim.size()) && is_rim(y);
      const int grey = away < 0 ? 20 : in_rim ? rim[size_t(away)] : 120;
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(grey));
    }
  }
  return scene;
}

test::Scene Rimmed(const std::vector<int>& rim) {
  return Rimmed(rim, [](int) { return true; });
}

TEST_CASE("matte: with one view, no contaminated rim remains sharp behind a defocused surface") {
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

TEST_CASE("matte: with one view, a halo stays beside a sharp surface") {
  const std::vector<int> row = MiddleRow(Rimmed({150, 150}), 6);
  CHECK(row[kEdge - 1] >= 140);
  CHECK(row[kEdge - 2] >= 140);
  CHECK(row[kEdge - 5] <= 125);
}

TEST_CASE("matte: with one view, neither texture nor a gradient beside an edge is a rim") {
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

TEST_CASE(
    "matte: with one view, coverage that is too small leaves hardly an outline at far focus") {
  test::Scene scene = Mixed(6, 0, 1, false, 20);
  scene.coverage.assign(size_t(kWidth * kHeight), 0);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      // The last far column shows the dark near surface, but its coverage is only a quarter.
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(x >= kEdge - 1 ? 20 : 200));
      scene.coverage[size_t(y * kWidth + x)] = x >= kEdge ? 255 : x == kEdge - 1 ? 64 : 0;
    }
  }
  // Without the larger share, the far surface would have level 23 in the last far column.
  const std::vector<int> row = MiddleRow(scene, 0);
  CHECK(row[kEdge - 1] >= 55);
  CHECK(row[kEdge] <= row[kEdge - 1] + 15);
}

TEST_CASE("matte: a pixel is split only if its surfaces move apart by more than a pixel") {
  // With three views along the radius, the outermost view is at 96/94 of the radius. With the
  // aperture 94/96, the outermost view is therefore at a distance of 1 from the centre view.
  constexpr double kAperture = 94.0 / 96, kLeast = 1.0 / 64;
  const std::vector<int> whole = MiddleRow(Mixed(0, -1, 5), 0, false, kAperture);
  CHECK(whole[kEdge - 2] > kFar);
  const std::vector<int> split = MiddleRow(Mixed(0, -1 - kLeast, 5), 0, false, kAperture);
  CHECK(split[kEdge - 2] == kFar);
}

TEST_CASE("matte: a pixel that is not a mixture of both surfaces is not split before the blur") {
  // Level 255 is brighter than the near surface, so the pixel is not a mixture.
  for (const int views : {1, 5}) {
    const std::vector<int> odd = MiddleRow(Mixed(0, -6, views, false, 255), 0);
    CAPTURE(views);
    CHECK(odd[kEdge - 4] > kFar);
  }
}

TEST_CASE("matte: with one view, a pixel between two other surfaces is not split before the blur") {
  test::Scene scene = Mixed(0, -6, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kEdge - 1; ++x) scene.Disparity(x, y) = -3;
  }
  CHECK(MiddleRow(scene, 0)[kEdge - 1] < 80);
}

TEST_CASE(
    "matte: the nearer surface covers a quarter of the mixed pixel at a slope, even if slices "
    "overlap") {
  test::Scene scene = Mixed(0, -8, 5);
  scene.disparity_min = -8;
  scene.disparity_max = 1;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = kEdge; x < kWidth; ++x) scene.Disparity(x, y) = float(-0.6 + 1.2 * y / kHeight);
  }
  test::Config config = test::ConfigFor(scene, 32);
  config.tuning.gather = 0;
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.tuning.max_layer = 0;
  const test::Refocused picture =
      test::RefocusScene(scene, config, test::Params(0, 1, STARFOCUS_MODE_BLOCK));
  for (int y = 2; y < kHeight - 2; ++y) {
    CAPTURE(y);
    CHECK(std::abs(picture.rgb[size_t(3 * (y * kWidth + kEdge - 1))] - 90) <= 16);
  }
}

// Makes a disc of one colour in front of a wall of another colour. Every view has mixed pixels
// around the disc.
test::Scene Disc(int views, double near, double far, int bright, int dark) {
  constexpr int kSide = 160, kParts = 4;
  test::Scene scene = test::EmptyScene(kSide, kSide, views, float(far), float(near));
  const auto covers = [](double x, double y) {
    return (x - 83.3) * (x - 83.3) + (y - 78.2) * (y - 78.2) < 30 * 30;
  };
  for (int view = 0; view < views; ++view) {
    const starfocus_position at = scene.PositionOf(view);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        int covered = 0;
        for (int part = 0; part < kParts * kParts; ++part) {
          const double dx = (part % kParts + 0.5) / kParts - 0.5;
          const double dy = (part / kParts + 0.5) / kParts - 0.5;
          covered += covers(x + dx + at.u * near, y + dy + at.v * near);
        }
        const int parts = kParts * kParts;
        std::fill_n(scene.Pixel(view, x, y), 3,
                    uint8_t((covered * bright + (parts - covered) * dark + parts / 2) / parts));
        if (view == 0) scene.Disparity(x, y) = float(covers(x, y) ? near : far);
      }
    }
  }
  return scene;
}

// Returns the largest difference from the wall's colour among pixels that light of the disc cannot
// reach. Light of the disc reaches only the blur of the disc and the mixed pixels around the disc.
int GlowOf(const test::Scene& scene, const test::Config& config, double focus, double near,
           int wall) {
  const test::Refocused picture =
      test::RefocusScene(scene, config, test::Params(focus, 1, STARFOCUS_MODE_BLOCK));
  const double reach = 30 + std::abs(near - focus) + 3;
  int most = 0;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      if ((x - 83.3) * (x - 83.3) + (y - 78.2) * (y - 78.2) < reach * reach) continue;
      for (int c = 0; c < 3; ++c) {
        const int value = picture.rgb[size_t(3 * (y * scene.width + x) + c)];
        most = std::max(most, std::abs(value - wall));
      }
    }
  }
  return most;
}

TEST_CASE("matte: no light of a subject reaches the wall, at any level and size of block") {
  constexpr double kSubject = 4, kWall = -32;
  for (const int views : {1, 5, 9, 17}) {
    for (const bool dark_subject : {false, true}) {
      const int subject = dark_subject ? 20 : 240, wall = dark_subject ? 240 : 20;
      const test::Scene scene = Disc(views, kSubject, kWall, subject, wall);
      for (const double focus : {4.0, 2.5, -2.0, -4.0, -10.0}) {
        for (const int max_layer : {0, 1, 2}) {
          for (const int block : {32, 64, 128, 256}) {
            test::Config config = test::ConfigFor(scene, 40);
            config.transfer = STARFOCUS_TRANSFER_NONE;
            config.tuning.max_layer = max_layer;
            config.superblock = block;
            CAPTURES(views, dark_subject, focus, max_layer, block);
            // With one view, the colours behind mixed pixels come from neighbouring pixels, which
            // is less exact.
            CHECK(GlowOf(scene, config, focus, kSubject, wall) <= (views == 1 ? 3 : 1));
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace matte_test
