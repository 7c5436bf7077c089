// SPDX-License-Identifier: Apache-2.0
// Compares the coverage map of the engine with the double-precision reference, both for coverage
// that the engine finds and for given coverage.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/conformance/reference.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/strands.h"
#include "tests/support/test_scene.h"

namespace coverage_conformance_slow_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kNear = 6, kFar = -6;

// Kind of disparity map: the exact disparity at the centre of each pixel, or a map in which
// outlines are ramps.
enum class Map { kCentres, kRamps };

// Returns the coverage of slanted strands in front of a wall.
double CoverageAt(double x, double y) {
  if (x < 6 || x > 52 || std::fabs(y - kHeight / 2.0) > 22) return 0;
  double left = 1;
  for (int k = 0; k < 20; ++k) {
    const double lean = k % 2 == 0 ? 0.23 : -0.31;
    const double at = 10 + 4 * k + lean * (y - kHeight / 2.0);
    const double thick = 0.8 + 0.3 * (k % 4);
    left *= 1 - std::clamp((1 + thick) / 2 - std::fabs(x - at), 0.0, std::min(1.0, thick));
  }
  return 1 - left;
}

double LightAt(double x, double y, int c, double u, double v) {
  const double coverage = CoverageAt(x + u * kNear, y + v * kNear);
  const double far_x = x + u * kFar, far_y = y + v * kFar;
  const double wall = 170 + 12 * c + 25 * std::sin(far_x / 19 + c) + 20 * std::cos(far_y / 23);
  return coverage * (60 - 12 * c) + (1 - coverage) * wall;
}

float DisparityAt(int x, int y, Map map) {
  // The disparities of the near and of the far surface vary.
  const double far = kFar + 0.4 * std::sin(x / 15.0), near = kNear - 0.01 * y;
  const auto is_near = [&](int column) { return CoverageAt(column, y) > 0.5 ? 1.0 : 0.0; };
  const double share =
      map == Map::kCentres ? is_near(x) : (is_near(x - 1) + 2 * is_near(x) + is_near(x + 1)) / 4;
  return float(std::clamp(far + share * (near - far), kFar, kNear));
}

test::Scene Strands(int views, Map map, bool given) {
  test::Scene scene = test::EmptyScene(kWidth, kHeight, views, float(kFar), float(kNear));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int view = 0; view < views; ++view) {
        const starfocus_position at = scene.PositionOf(view);
        for (int c = 0; c < 3; ++c) {
          scene.Pixel(view, x, y)[c] = uint8_t(std::lround(LightAt(x, y, c, at.u, at.v)));
        }
      }
      scene.Disparity(x, y) = DisparityAt(x, y, map);
      if (given) scene.coverage.push_back(uint8_t(std::lround(255 * CoverageAt(x, y))));
    }
  }
  return scene;
}

// Makes random noisy strands in front of a surface. The side views of this scene do not show the
// same scene as the centre view.
test::Scene RandomStrands(bool given, uint64_t seed) {
  test::Random random(seed);
  constexpr int kViews[] = {1, 5, 9, 17};
  test::Scene scene = test::EmptyScene(kWidth, kHeight, kViews[random.Int(0, 3)],
                                       float(random.Real(-12, 0)), float(random.Real(5.5, 12)));
  const test::Strands strands = test::DrawStrands(&random);
  int near[3], far[3];
  for (int c = 0; c < 3; ++c) near[c] = random.Byte(), far[c] = random.Byte();
  const int noise = random.Int(0, 20);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int coverage = strands.CoverageAt(x, y);
      for (int view = 0; view < scene.views(); ++view) {
        for (int c = 0; c < 3; ++c) {
          const int light = test::Mixture(coverage, near[c], far[c]) + random.Int(-noise, noise);
          scene.Pixel(view, x, y)[c] = uint8_t(std::clamp(light, 0, 255));
        }
      }
      const float share = float(strands.DepthAt(x, y)) / 255;
      scene.Disparity(x, y) =
          std::min(scene.disparity_min + share * (scene.disparity_max - scene.disparity_min),
                   scene.disparity_max);
      if (given) scene.coverage.push_back(uint8_t(coverage));
    }
  }
  return scene;
}

// Returns the engine's coverage map of the whole picture, which fits into one stripe.
std::vector<reference::PartedPixel> EnginesPixels(const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene);
  config.transfer = STARFOCUS_TRANSFER_NONE;
  config.superblock = 64;
  test::Engine engine(config);
  test::Output out(scene.width, scene.height);
  REQUIRE(test::Refocus(&engine, test::Params(scene.disparity_min, 1, STARFOCUS_MODE_BLOCK), scene,
                        &out) == STARFOCUS_OK);
  const starfocus::CoverageMap& map = test::StateOf(engine.get()).stripe.coverage;
  REQUIRE(map.tile_rows >= map.Rows());
  std::vector<reference::PartedPixel> pixels;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const size_t at = map.At(x, y);
      const starfocus::CoverageTile& tile =
          map.Tile(x / starfocus::kCoverageTile, y / starfocus::kCoverageTile);
      reference::PartedPixel pixel;
      pixel.parted = tile.thin != 0 && map.alpha[at] != starfocus::kUnsplit;
      if (pixel.parted) {
        const starfocus::FarLight& far = map.FarAt(x, y);
        pixel.alpha = double(map.alpha[at]) / starfocus::kWhole;
        pixel.near = map.near[at];
        pixel.far = far.disparity;
        for (size_t c = 0; c < 3; ++c) {
          pixel.light[c] = double(far.rgb[c]) / (1 << starfocus::kLightBits);
        }
      }
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

struct Distance {
  // Numbers of pixels that the engine and the reference both split into two surfaces, and that only
  // one of them splits.
  int parted = 0, otherwise = 0;
  // Number of pixels that the engine and the reference split into surfaces of different
  // disparities.
  int disparities = 0;
  // Number of split pixels in which the coverage of the engine and the reference differs by more
  // than kCoverageLimit; number of split pixels in which the light of the farther surface differs
  // by more than kLightLimit.
  int alphas = 0, lights = 0;
  double alpha = 0, alpha_sum = 0;  // Largest and summed difference of coverage.
  // Largest and summed difference of the light of the farther surface, in codes.
  double light = 0, light_sum = 0;

  void Add(const Distance& other) {
    parted += other.parted;
    otherwise += other.otherwise;
    disparities += other.disparities;
    alphas += other.alphas;
    lights += other.lights;
    alpha = std::max(alpha, other.alpha);
    light = std::max(light, other.light);
    alpha_sum += other.alpha_sum;
    light_sum += other.light_sum;
  }
};

// The engine stores coverage in steps of 1/128, which causes an error of at most 1/256, and of
// 1/512 on average. The engine compares colours in steps of 1/8 code. The certainty of the farther
// surface's light has steps of 1/256, and computing the eighth power of coverage loses up to two
// steps. A loss of two steps matters where the certainty is low, for example where a view sees
// between strands. At some pixels, the engine and the reference may decide differently whether a
// pixel mixes two colours, or whether a strand covers a point.
constexpr double kCoverageLimit = 2.0 / 128, kCoverageMean = 1.0 / 256;
constexpr double kLightLimit = 1, kLightMean = 0.25;

Distance Compare(const std::vector<reference::PartedPixel>& pixels,
                 const std::vector<reference::PartedPixel>& exact) {
  REQUIRE(pixels.size() == exact.size());
  Distance distance;
  for (size_t n = 0; n < pixels.size(); ++n) {
    const reference::PartedPixel &a = pixels[n], &b = exact[n];
    if (a.parted != b.parted) ++distance.otherwise;
    if (!a.parted || !b.parted) continue;
    double light = 0;
    for (size_t c = 0; c < 3; ++c) light = std::max(light, std::fabs(a.light[c] - b.light[c]));
    const double alpha = std::fabs(a.alpha - b.alpha);
    distance.Add({1, 0, a.near != b.near || a.far != b.far ? 1 : 0, alpha > kCoverageLimit ? 1 : 0,
                  light > kLightLimit ? 1 : 0, alpha, alpha, light, light});
  }
  return distance;
}

Distance Check(const test::Scene& scene) {
  const Distance distance =
      Compare(EnginesPixels(scene), reference::PartPixels(scene, STARFOCUS_TRANSFER_NONE));
  const int percent = distance.parted / 100;
  CHECK(distance.otherwise <= percent);
  CHECK(distance.disparities == 0);
  CHECK(distance.alphas <= percent);
  CHECK(distance.lights <= percent);
  CHECK(distance.alpha_sum <= kCoverageMean * distance.parted);
  CHECK(distance.light_sum <= kLightMean * distance.parted);
  return distance;
}

void Print(const char* name, const Distance& distance) {
  std::printf(
      "%s: %d pixels split, %d only by the engine or only by the reference; "
      "coverage errors: %d above 2/128, largest %.4f, mean %.5f; "
      "errors of far light: %d above 1, largest %.3f, mean %.4f\n",
      name, distance.parted, distance.otherwise, distance.alphas, distance.alpha,
      distance.alpha_sum / distance.parted, distance.lights, distance.light,
      distance.light_sum / distance.parted);
}

constexpr int kViews[] = {1, 5, 17};

TEST_CASE("coverage: with given coverage, the engine splits pixels like the reference") {
  for (const Map map : {Map::kCentres, Map::kRamps}) {
    Distance all;
    for (const int views : kViews) {
      CAPTURE(views);
      const Distance distance = Check(Strands(views, map, true));
      CHECK(distance.parted > 2500);
      CHECK(distance.parted < kWidth * kHeight - 500);
      all.Add(distance);
    }
    Print(map == Map::kRamps ? "given coverage, a map of ramps" : "given coverage", all);
  }
}

TEST_CASE("coverage: without given coverage, the engine splits pixels like the reference") {
  Distance all;
  for (const int views : kViews) {
    CAPTURE(views);
    const Distance distance = Check(Strands(views, Map::kCentres, false));
    CHECK(distance.parted > 2000);
    all.Add(distance);
  }
  Print("found coverage", all);
}

TEST_CASE("coverage: the engine splits random strands like the reference") {
  for (const bool given : {true, false}) {
    Distance all;
    for (uint64_t seed = 1; seed <= 12; ++seed) {
      CAPTURE(given);
      CAPTURE(seed);
      all.Add(Check(RandomStrands(given, seed)));
    }
    CHECK(all.parted > 20000);
    Print(given ? "random strands, given coverage" : "random strands, found coverage", all);
  }
}

}  // namespace
}  // namespace coverage_conformance_slow_test
