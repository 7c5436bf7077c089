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
#include "tests/support/hair.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace coverage_conformance_slow_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// Draws strands in front of a surface. With `parallax`, side views show the strands and the surface
// moved by their disparities, the disparities of both vary, and a part of the picture has no
// strands. Otherwise all views show the same place with noise, so that side views do not show the
// scene of the centre view.
test::Scene RandomStrands(bool given, bool parallax, uint64_t seed) {
  test::Random random(seed);
  constexpr int kViews[] = {1, 5, 9, 17};
  test::Scene scene = test::EmptyScene(kWidth, kHeight, kViews[random.Int(0, 3)],
                                       float(random.Real(-12, 0)), float(random.Real(5.5, 12)));
  const double nearest = scene.disparity_max, farthest = scene.disparity_min;
  const test::Strands strands = test::DrawStrands(&random);
  const auto share_at = [&](double x, double y, bool of_map) {
    if (parallax && (x < 6 || x > 62 || std::fabs(y - kHeight / 2.0) > 26)) return 0;
    const int column = int(std::lround(x)), row = int(std::lround(y));
    return of_map ? strands.DepthAt(column, row) : strands.CoverageAt(column, row);
  };
  int near[3], far[3];
  for (int c = 0; c < 3; ++c) near[c] = random.Byte(), far[c] = random.Byte();
  const int noise = parallax ? 0 : random.Int(0, 20);
  const double moves = parallax ? 1 : 0;
  reference::ForEachPixel(kWidth, kHeight, [&](int x, int y) {
    for (int view = 0; view < scene.views(); ++view) {
      const double u = moves * scene.PositionOf(view).u, v = moves * scene.PositionOf(view).v;
      const int coverage = share_at(x + u * nearest, y + v * nearest, false);
      const double shade = moves * 20 * std::sin((x + u * farthest) / 19 + (y + v * farthest) / 23);
      for (int c = 0; c < 3; ++c) {
        const int wall = std::clamp(far[c] + int(std::lround(shade)), 0, 255);
        const int light = test::Mixture(coverage, near[c], wall) + random.Int(-noise, noise);
        scene.Pixel(view, x, y)[c] = uint8_t(std::clamp(light, 0, 255));
      }
    }
    const double back = farthest + moves * (0.4 + 0.4 * std::sin(x / 15.0));
    const double front = nearest - moves * 0.01 * y;
    scene.Disparity(x, y) =
        std::min(float(back + share_at(x, y, true) / 255.0 * (front - back)), scene.disparity_max);
    if (given) scene.coverage.push_back(uint8_t(share_at(x, y, false)));
  });
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
  reference::ForEachPixel(scene.width, scene.height, [&](int x, int y) {
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
  });
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

TEST_CASE("coverage: the engine splits random strands like the reference") {
  for (const bool given : {true, false}) {
    for (const bool parallax : {true, false}) {
      Distance all;
      for (uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURES(given, parallax, seed);
        all.Add(Check(RandomStrands(given, parallax, seed)));
      }
      CHECK(all.parted > (parallax ? 10000 : 20000));
      Print(given ? "given coverage" : "found coverage", all);
    }
  }
}

}  // namespace
}  // namespace coverage_conformance_slow_test
