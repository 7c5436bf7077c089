// SPDX-License-Identifier: Apache-2.0
// Tests the ray-traced scenes, and the strands of scenes and their coverage.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "examples/scene/builders.h"
#include "examples/scene/noise.h"
#include "examples/scene/render.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace test {

// Returns the PSNR of two pictures in dB, or 99 if the pictures are equal.
inline double Psnr(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum == 0 ? 99 : 10 * std::log10(255.0 * 255.0 * double(a.size()) / sum);
}

}  // namespace test

namespace starfocus::scene_slow_test {
namespace {

const char* const kNames[] = {"portrait", "wires", "ramp", "hair", "grass", "cutout"};
const char* const kStrandNames[] = {"hair", "grass", "cutout"};

Scene Made(const std::string& name, uint32_t seed = kSceneSeed) {
  return MakeScene(name, seed).value();
}

SceneOpening DefaultOpening() {
  starfocus::Params params;
  return SceneOpening(params);
}

TEST_CASE("scene: pictures depend on the seed, and not on the number of threads") {
  ThreadRunner one(1), three(3);
  constexpr int kOdd = 61;
  for (const char* name : kNames) {
    CAPTURE(std::string(name));
    const Scene scene = Made(name), again = Made(name), other = Made(name, 2);
    const RayTracer a(scene, kOdd, 47, STARFOCUS_TRANSFER_NONE, &one),
        b(again, kOdd, 47, STARFOCUS_TRANSFER_NONE, &three),
        c(other, kOdd, 47, STARFOCUS_TRANSFER_NONE, &three);
    CHECK(a.View(-0.5, 1, nullptr).pixels == b.View(-0.5, 1, nullptr).pixels);
    CHECK(a.Truth({1, 1}, 0.8, DefaultOpening(), nullptr).pixels ==
          b.Truth({1, 1}, 0.8, DefaultOpening(), nullptr).pixels);
    CHECK(a.Disparity().values == b.Disparity().values);
    CHECK(scene.seeded == (std::count(kStrandNames, kStrandNames + 3, std::string(name)) == 1));
    if (!scene.seeded) continue;
    CHECK(a.Coverage(nullptr) == b.Coverage(nullptr));
    CHECK(a.Coverage(nullptr) != c.Coverage(nullptr));
  }
}

TEST_CASE("scene: at any size, disparities are finite, and decrease over the points to focus on") {
  ThreadRunner runner(1);
  for (const char* name : kNames) {
    const Scene scene = Made(name);
    REQUIRE(scene.points.size() == (name == std::string("cutout") ? 2 : 3));
    for (const int width : {1, 2, 300}) {
      const RayTracer renderer(scene, width, 3, STARFOCUS_TRANSFER_NONE, &runner);
      CHECK(renderer.View(1, -1, nullptr).pixels.size() == size_t(9 * width));
      for (const float d : renderer.Disparity().values) CHECK(std::isfinite(d));
    }
    for (const int width : {1024, 96, 40}) {
      const int height = width == 40 ? 90 : width * 3 / 4;
      const RayTracer renderer(scene, width, height, STARFOCUS_TRANSFER_NONE, &runner);
      const FloatMap map = renderer.Disparity();
      std::vector<float> disparity;
      for (const NamedPoint& point : scene.points) {
        int x = -1, y = -1;
        renderer.ToPixel(point.x, point.y, &x, &y);
        REQUIRE((x >= 0 && x < width && y >= 0 && y < height));
        disparity.push_back(map.at(x, y));
      }
      CHECK(std::is_sorted(disparity.rbegin(), disparity.rend(), std::less_equal<float>()));
    }
  }
  CHECK_FALSE(MakeScene("other"));
}

TEST_CASE("scene: rays meet planes and ellipsoids at the analytically computed points") {
  Surface plane = Piece(Outline::kNone, {10, 20, 3}, {0, 0}, {});
  plane.slope_x = 0.1;
  plane.slope_y = -0.2;
  const Ray ray = {4, -7, 0.6, -0.8};
  Hit hit;
  REQUIRE(Intersect(plane, ray, &hit));
  CHECK(hit.d == doctest::Approx(3 + 0.1 * (hit.x - 10) - 0.2 * (hit.y - 20)));
  CHECK(hit.x == doctest::Approx(4 + 0.6 * hit.d));
  CHECK(hit.y == doctest::Approx(-7 - 0.8 * hit.d));

  const Surface ball = Turned(Ellipsoid({1, 2, 4}, {30, 20, 5}, {}), 3, 4);
  REQUIRE(Intersect(ball, {1, 2, 0, 0}, &hit));
  CHECK(hit.d == doctest::Approx(9));
  CHECK(hit.nz == doctest::Approx(1));
  REQUIRE(Intersect(ball, ray, &hit));
  const double lx = 0.6 * (hit.x - 1) + 0.8 * (hit.y - 2);
  const double ly = 0.6 * (hit.y - 2) - 0.8 * (hit.x - 1), ld = hit.d - 4;
  CHECK(lx * lx / 900 + ly * ly / 400 + ld * ld / 25 == doctest::Approx(1));
  CHECK(hit.lx == doctest::Approx(lx));
  CHECK_FALSE(Intersect(ball, {200, 2, 0, 0}, &hit));
}

TEST_CASE("scene: the bounding box of a surface contains every point where rays hit the surface") {
  for (const char* name : kNames) {
    const Scene scene = Made(name);
    int outside = 0;
    for (const Surface& surface : scene.surfaces) {
      const Bounds box = SurfaceBounds(surface, 1200);
      for (int k = 0; k < 400; ++k) {
        const Ray ray = {1024 * HashUnit(k, 0, 5) - 512, 768 * HashUnit(k, 1, 5) - 384,
                         2 * HashUnit(k, 2, 5) - 1, 2 * HashUnit(k, 3, 5) - 1};
        Hit hit;
        if (!Intersect(surface, ray, &hit)) continue;
        // The least distance of the hit to a side of the box, negative outside.
        const double inside = std::min({hit.x - box.x0, box.x1 - hit.x, hit.y - box.y0,
                                        box.y1 - hit.y, hit.d - box.d0, box.d1 - hit.d});
        outside += inside < -1e-6 ? 1 : 0;
      }
    }
    CHECK(outside == 0);
  }
}

TEST_CASE("noise: values are in range, continuous and not constant") {
  double low = 1, high = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = i * 0.37 - 500, y = i * 0.11 - 200;
    const double value = Fractal(x, y, 5, 3);
    low = std::fmin(low, value);
    high = std::fmax(high, value);
    CHECK(std::fabs(Noise(x + 1e-6, y, 3) - Noise(x, y, 3)) < 1e-5);
  }
  CHECK(low >= 0);
  CHECK(high <= 1);
  CHECK(high - low > 0.4);
  CHECK(Wrap(-0.25, 1) == doctest::Approx(0.75));
  CHECK(Triangle(0.5, 1) == doctest::Approx(1));
}

TEST_CASE("strands: rays meet the nearest strand at the analytically computed point") {
  // A strand along x, 2 units thick, and a nearer strand along y.
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
  // Seen from position (1, 0) of the lens, the nearer strand is 5 units to the left, and does not
  // hide the farther strand at x = 0.
  CHECK(strands.Find({0, 0.25}, 1, 0, &hit));
  CHECK(hit.d == 3);
  REQUIRE(strands.Find({-5, 0.25}, 1, 0, &hit));
  CHECK(hit.d == 5);
  CHECK_FALSE(strands.Find({-20, 0}, 0, 1, &hit));
  CHECK(strands.Find({-20, -3}, 0, 1, &hit));
}

TEST_CASE("strands: the search in a grid finds the nearest of 200 random strands") {
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

TEST_CASE("strand scenes: the coverage of a pixel is the share that a half plane covers") {
  Scene scene;
  // A bar with its left edge at x = 0.3. With the size 1024 x 768, one canvas unit is one pixel.
  scene.surfaces.push_back(Piece(Outline::kBox, {100.3, 0, 5}, {100, 1000}, {}));
  scene.surfaces.back().foreground = true;
  ThreadRunner runner(1);
  const RayTracer tracer(scene, 1024, 768, STARFOCUS_TRANSFER_NONE, &runner);
  const std::vector<uint8_t> coverage = tracer.Coverage(nullptr);
  // Pixel 512 spans the range of x from 0 to 1.
  const auto level = [&](int x) { return coverage[size_t(400 * 1024 + x)]; };
  CHECK(level(511) == 0);
  CHECK(std::abs(level(512) - 0.7 * 255) <= 1);
  CHECK(level(513) == 255);
}

}  // namespace
}  // namespace starfocus::scene_slow_test
