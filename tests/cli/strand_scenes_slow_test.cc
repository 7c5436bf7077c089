// SPDX-License-Identifier: Apache-2.0
// The scenes hair and grass: strands, coverage, and how the program writes them.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "examples/scene/builders.h"
#include "examples/scene/noise.h"
#include "examples/scene/render.h"
#include "starfocus/starfocus.h"

namespace starfocus::strand_scenes_slow_test {
namespace {

constexpr int kWidth = 256, kHeight = 192;
const char* const kNames[] = {"hair", "grass"};

Scene Made(const std::string& name, uint32_t seed = kSceneSeed) {
  return MakeScene(name, seed).value();
}

// Returns 1 or 0 if the map has one side of the step alone within a pixel of (x, y), else -1.
int SideAround(const FloatMap& map, int x, int y) {
  int near = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) near += map.at(x + dx, y + dy) > 0 ? 1 : 0;
  }
  return near == 9 ? 1 : near == 0 ? 0 : -1;
}

// Returns 1 or 0 if all or nothing is covered within a pixel of (x, y), else -1.
int CoverAround(const std::vector<uint8_t>& coverage, int x, int y) {
  int whole = 0, none = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int level = coverage[size_t((y + dy) * kWidth + x + dx)];
      whole += level == 255 ? 1 : 0;
      none += level == 0 ? 1 : 0;
    }
  }
  return whole == 9 ? 1 : none == 9 ? 0 : -1;
}

double MeanDifference(const Image& a, const Image& b) {
  double sum = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) sum += std::fabs(double(a.pixels[i]) - b.pixels[i]);
  return sum / double(a.pixels.size());
}

TEST_CASE("strands: rays meet the nearest strand where algebra says") {
  // A strand along x, 2 units thick, and one along y before it.
  const Strands strands(
      {{{-50, 0}, {0, 0}, {50, 0}, 1, 1, 3}, {{0, -50}, {0, 0}, {0, 50}, 0.5, 0.5, 5}});
  StrandHit hit;
  REQUIRE(strands.Find({-20, 0.5}, 0, 0, &hit));
  CHECK(hit.strand == 1);
  CHECK(hit.d == 3);
  CHECK(hit.along == doctest::Approx(30));
  CHECK(hit.across == doctest::Approx(0.5));
  CHECK_FALSE(strands.Find({-20, 1.01}, 0, 0, &hit));
  CHECK_FALSE(strands.Find({-51.01, 0}, 0, 0, &hit));
  REQUIRE(strands.Find({0, 0.25}, 0, 0, &hit));
  CHECK(hit.strand == 0);
  // Through (1, 0) of the lens the front strand lies 5 units to the left, the other one as before.
  CHECK(strands.Find({0, 0.25}, 1, 0, &hit));
  CHECK(hit.d == 3);
  REQUIRE(strands.Find({-5, 0.25}, 1, 0, &hit));
  CHECK(hit.d == 5);
  CHECK_FALSE(strands.Find({-20, 0}, 0, 1, &hit));
  CHECK(strands.Find({-20, -3}, 0, 1, &hit));
}

TEST_CASE("strands: the grid hides no strand") {
  std::vector<Strand> many;
  for (int i = 0; i < 200; ++i) {
    const auto at = [i](int k, double size) { return size * (HashUnit(i, k, 4) - 0.5); };
    many.push_back({{at(0, 300), at(1, 200)},
                    {at(2, 300), at(3, 200)},
                    {at(4, 300), at(5, 200)},
                    0.2 + HashUnit(i, 6, 4),
                    0.3,
                    8 + at(7, 4)});
  }
  const Strands all(many);
  std::vector<Strands> single;
  for (const Strand& strand : many) single.emplace_back(std::vector<Strand>{strand});
  int met = 0, wrong = 0;
  for (int k = 0; k < 4000; ++k) {
    const Point at = {300 * (HashUnit(k, 0, 6) - 0.5), 200 * (HashUnit(k, 1, 6) - 0.5)};
    const double u = 2 * HashUnit(k, 2, 6) - 1, v = 2 * HashUnit(k, 3, 6) - 1;
    double nearest = -1;
    StrandHit hit;
    for (const Strands& strand : single) {
      if (strand.Find(at, u, v, &hit)) nearest = std::fmax(nearest, hit.d);
    }
    const double found = all.Find(at, u, v, &hit) ? hit.d : -1;
    met += nearest >= 0 ? 1 : 0;
    wrong += found != nearest ? 1 : 0;
  }
  CHECK(met > 400);
  CHECK(wrong == 0);
}

TEST_CASE("strand scenes: coverage agrees with the map") {
  ThreadRunner runner(2);
  for (const char* name : kNames) {
    CAPTURE(std::string(name));
    const Scene scene = Made(name);
    const RayTracer tracer(scene, kWidth, kHeight, STARFOCUS_TRANSFER_NONE, &runner);
    const FloatMap map = tracer.Disparity();
    const std::vector<uint8_t> coverage = tracer.Coverage(nullptr);
    int clear = 0, against = 0, fractions = 0, lost = 0;
    double covered = 0, near = 0;
    for (int y = 1; y + 1 < kHeight; ++y) {
      for (int x = 1; x + 1 < kWidth; ++x) {
        const int level = coverage[size_t(y * kWidth + x)];
        const int cover = CoverAround(coverage, x, y);
        covered += level / 255.0;
        near += map.at(x, y) > 0 ? 1 : 0;
        clear += cover >= 0 ? 1 : 0;
        against += cover >= 0 && SideAround(map, x, y) != cover ? 1 : 0;
        fractions += level > 0 && level < 255 ? 1 : 0;
        // Strands that the map does not have.
        lost += level > 0 && SideAround(map, x, y) == 0 ? 1 : 0;
      }
    }
    CHECK(clear > kWidth * kHeight / 3);
    CHECK(against == 0);
    CHECK(fractions > kWidth * kHeight / 20);
    CHECK(lost > 100);
    // Pixel centres sample the area.
    CHECK(covered == doctest::Approx(near).epsilon(0.02));
  }
}

TEST_CASE("strand scenes: coverage is the area of a half plane") {
  Scene scene;
  // A bar with its left rim at x = 0.3 canvas units: here pixels.
  scene.surfaces.push_back(Piece(Outline::kBox, {100.3, 0, 5}, {100, 1000}, {}));
  scene.surfaces.back().foreground = true;
  ThreadRunner runner(1);
  const RayTracer tracer(scene, 1024, 768, STARFOCUS_TRANSFER_NONE, &runner);
  const std::vector<uint8_t> coverage = tracer.Coverage(nullptr);
  // Pixel 512 spans 0 to 1.
  const auto level = [&](int x) { return coverage[size_t(400 * 1024 + x)]; };
  CHECK(level(511) == 0);
  CHECK(std::abs(level(512) - 0.7 * 255) <= 1);
  CHECK(level(513) == 255);
}

TEST_CASE("strand scenes: truth through a pinhole is the centre view") {
  ThreadRunner runner(2);
  starfocus_params params;
  starfocus_params_init(&params);
  for (const char* name : kNames) {
    const Scene scene = Made(name);
    const RayTracer tracer(scene, kWidth, kHeight, STARFOCUS_TRANSFER_NONE, &runner);
    const Image centre = tracer.View(0, 0, nullptr);
    const SceneOpening opening(params.lens);
    CHECK(MeanDifference(centre, tracer.Truth(9, 1e-6, opening, nullptr)) < 1);
    CHECK(MeanDifference(centre, tracer.Truth(9, 1, opening, nullptr)) > 4);
  }
}

TEST_CASE("strand scenes: a seed gives the same scene again, another seed another scene") {
  ThreadRunner one(1), three(3);
  for (const char* name : kNames) {
    const Scene scene = Made(name), again = Made(name), other = Made(name, 2);
    CHECK(scene.seeded);
    const RayTracer a(scene, 120, 90, STARFOCUS_TRANSFER_NONE, &one);
    const RayTracer b(again, 120, 90, STARFOCUS_TRANSFER_NONE, &three);
    const RayTracer c(other, 120, 90, STARFOCUS_TRANSFER_NONE, &three);
    CHECK(a.Coverage(nullptr) == b.Coverage(nullptr));
    CHECK(a.Coverage(nullptr) != c.Coverage(nullptr));
    CHECK(a.View(1, 0, nullptr).pixels == b.View(1, 0, nullptr).pixels);
  }
}

}  // namespace
}  // namespace starfocus::strand_scenes_slow_test
