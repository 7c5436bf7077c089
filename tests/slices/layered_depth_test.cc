// SPDX-License-Identifier: Apache-2.0
// Tests the hidden surfaces of a light field, and the positions in views at which colours of hidden
// surfaces are read.
#include "lib/slices/layered_depth.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "tests/slices/layered_scene.h"

namespace layered_depth_test {
namespace {

using Scene = test::LayeredScene;
using starfocus::LayeredDepth;
using test::kArea;
using test::kSize;

TEST_CASE("surfaces: captured views show the background behind a near square") {
  for (const int views : {5, 9, 17}) {
    Scene scene(views);
    scene.Fill(0, kSize, 0, kSize, 1, 10);
    scene.Fill(12, 28, 12, 28, 5, 90);
    scene.Find();
    CAPTURE(views);
    // A view at distance 1 sees the far surface up to four pixels behind the edge. The engine finds
    // the far surface up to five pixels behind the edge.
    for (int x = 12; x < 28; ++x) {
      const int distance = std::min(x - 11, 28 - x);
      CHECK(scene.Behind(x, 20) == (distance <= 5 ? 1 : -1000));
    }
    // The left view shows the point of the far surface one pixel farther to the right than the
    // centre view.
    CHECK(scene.Colour(13, 20, 2) == 2);
    CHECK(scene.Colour(13, 20, 0) == 14);
    CHECK(scene.Colour(13, 20, 1) == 20);
    CHECK(scene.Colour(26, 20, 2) == 1);
    CHECK(scene.Colour(26, 20, 0) == 25);
    CHECK(scene.Colour(20, 26, 2) == 3);
    CHECK(scene.Colour(20, 26, 1) == 25);
    CHECK(scene.Behind(5, 5) == -1000);
    CHECK(scene.Behind(13, 20, 2) == -1000);
    CHECK(scene.share[scene.surfaces.At(12, 20)] == starfocus::simd::kSliceEnd);
    CHECK(scene.share[scene.surfaces.At(13, 20)] == starfocus::simd::kSliceWhole);
    CHECK(scene.share[scene.surfaces.At(11, 20)] == starfocus::simd::kSliceWhole);
    CHECK(scene.surfaces.low == 64);
    CHECK(scene.surfaces.high == 5 * 64);
  }
}

TEST_CASE("surfaces: a pair sees behind edges on one side; elsewhere the background continues") {
  Scene scene(17);
  test::SetPositions({{1, 0}}, &scene.input);
  scene.Fill(0, kSize, 0, kSize, 1, 10);
  scene.Fill(12, 28, 12, 28, 5, 90);
  scene.Find();
  CHECK(scene.Behind(26, 20) == 1);
  CHECK(scene.Colour(26, 20, 2) == 1);
  CHECK(scene.Colour(26, 20, 0) == 25);
  for (const auto& [x, y] : {std::pair(13, 20), std::pair(20, 13), std::pair(20, 26)}) {
    CHECK(scene.Behind(x, y) == 1);
    CHECK(scene.Colour(x, y, 2) == 10);
  }
  // In a corner, a background that a view sees takes precedence over a background at a shorter
  // distance.
  CHECK(scene.Colour(26, 27, 2) == 1);
}

TEST_CASE("surfaces: a view at any position supplies the hidden pixels that it shows") {
  for (const starfocus_position& at :
       {starfocus_position{0.5, 0.25}, starfocus_position{0.75, -0.5}}) {
    Scene scene(17);
    test::SetPositions({at}, &scene.input);
    scene.Fill(0, kSize, 0, kSize, 4, 10);
    scene.Fill(12, 28, 12, 28, 12, 90);
    scene.Find();
    CAPTURE(at.u);
    // A near pixel moves by 8 u relative to the far surface.
    const int seen = int(8 * at.u);
    for (int x = 20; x < 28; ++x) {
      CAPTURE(x);
      CHECK(scene.Behind(x, 20) == 4);
      const bool shown = 28 - x <= seen;
      CHECK((scene.Colour(x, 20, 2) == 1) == shown);
      if (!shown) continue;
      CHECK(scene.Colour(x, 20, 0) == x - int(4 * at.u));
      CHECK(scene.Colour(x, 20, 1) == 20 - int(4 * at.v));
    }
    CHECK(scene.Colour(13, 20, 2) == 10);
  }
}

TEST_CASE("surfaces: if the farther of two views does not show a pixel, the nearer view is used") {
  Scene scene(17);
  test::SetPositions({{1, 0}, {0.25, 0}}, &scene.input);
  scene.Fill(0, kSize, 0, kSize, 0, 10);
  scene.Fill(10, 14, 0, kSize, 4, 90);
  scene.Fill(15, 25, 0, kSize, 4, 90);  // only the nearer view sees through the gap
  scene.Find();
  CHECK(scene.Colour(13, 20, 2) == 2);
  CHECK(scene.Colour(12, 20, 2) != 2);
  CHECK(scene.Colour(24, 20, 2) == 1);
}

TEST_CASE("surfaces: without a captured view the background continues") {
  Scene scene(1);
  scene.Fill(0, kSize, 0, kSize, 1, 10);
  scene.Fill(20, kSize, 0, kSize, 4, 90);
  scene.Find();
  CHECK(scene.Behind(20, 20) == 1);
  CHECK(scene.Colour(20, 20, 1) == 10);
}

TEST_CASE("surfaces: hidden pixels are not read from views in which another surface covers them") {
  // A slit of two pixels between near surfaces, which cover the slit as seen from either side.
  Scene scene(5);
  scene.Fill(0, kSize, 0, kSize, 5, 90);
  scene.Fill(20, 22, 0, kSize, 0, 10);
  scene.Find();
  CHECK(scene.Behind(19, 20) == 0);
  CHECK(scene.Colour(19, 20, 1) == 10);
  // A pixel farther from the slit is visible through the slit.
  CHECK(scene.Behind(16, 20) == 0);
  CHECK(scene.Colour(16, 20, 0) == 16);
  CHECK(scene.Colour(16, 20, 2) == 1);
}

TEST_CASE(
    "surfaces: a hidden pixel at the same distance from two edges is the mean of both views") {
  Scene scene(5);
  scene.Fill(0, kSize, 0, kSize, 0, 10);
  scene.Fill(20, 21, 0, kSize, 4, 90);
  scene.Find();
  CHECK(scene.Behind(20, 20) == 0);
  CHECK(scene.Colour(20, 20, 0) == 20);
  CHECK(scene.Colour(20, 20, 2) == 2);  // mean of views 1 and 2, rounded half up
}

TEST_CASE("surfaces: two surfaces may be hidden behind a third surface") {
  Scene scene(5);
  scene.Fill(0, kSize, 0, 20, 0, 10);
  scene.Fill(0, kSize, 20, kSize, 3, 40);
  scene.Fill(18, 22, 18, 22, 8, 90);
  scene.Find();
  CHECK(scene.Behind(18, 20) == 3);
  CHECK(scene.Behind(18, 20, 2) == 0);
}

TEST_CASE("surfaces: a hidden surface may itself have an edge") {
  // A strip is 6 pixels in front of a wall, and another surface is 3 pixels in front of the strip.
  for (const int start : {16, 13, 12}) {
    Scene scene(5);
    scene.Fill(0, kSize, 0, kSize, -5, 10);
    scene.Fill(start, 20, 0, kSize, 1, 40);
    scene.Fill(20, kSize, 0, kSize, 4, 90);
    scene.Find();
    CAPTURE(start);
    for (int x = 20; x < 28; ++x) {
      CAPTURE(x);
      CHECK(scene.Behind(x, 20) == (x < 24 ? 1 : -1000));
      // The last pixel of the strip hides the wall up to 6 pixels away, and pixel x hides the wall
      // up to 9 pixels away.
      const bool shown = x < 24 && start >= 13 && x - start <= 9;
      CHECK(scene.Behind(x, 20, 2) == (shown ? -5 : -1000));
    }
    if (start < 16) continue;
    // The left view shows the wall five pixels farther to the left, next to the strip.
    CHECK(scene.Colour(20, 20, 2, 2) == 2);
    CHECK(scene.Colour(20, 20, 0, 2) == 15);
  }
}

TEST_CASE(
    "surfaces: at disparity steps of 2/64 to 3/4 pixel, a pixel hides a copy of its neighbour") {
  for (const double step : {0.25, 0.75}) {
    Scene scene(5);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) scene.Set(x, y, step * (x % 4), x);
    }
    scene.Find();
    for (const int x : {9, 10}) {
      CAPTURES(step, x);
      CHECK(scene.Behind(x, 20) == doctest::Approx(step * (x % 4) - step));
      CHECK(scene.Colour(x, 20, 2) == scene.Colour(x - 1, 20, 2, 0));
    }
  }
}

TEST_CASE("surfaces: disparity steps below 2/64 pixel hide nothing") {
  for (const double slope : {0.0, 0.016, -0.016}) {
    Scene scene(5);
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) scene.Set(x, y, slope * x, x);
    }
    scene.Find();
    CHECK(std::all_of(scene.hiding.begin(), scene.hiding.end(), [](uint64_t h) { return h == 0; }));
  }
  Scene steep(5);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) steep.Set(x, y, 0.8 * x, x);
  }
  steep.Find();
  CHECK(steep.hiding[20] != 0);
}

// Returns the distance from (x, y) to the next depth edge's far side, or 0 if the pixel does not
// hide the far side. A step of up to an eighth of the depth that the previous edge hides does not
// count as an edge.
int Distance(const Scene& scene, int x, int y, int dx, int dy) {
  const auto at = [&](int t) {
    return int(scene.disparity[size_t((y + dy * t) * kSize + x + dx * t)]);
  };
  const auto hides = [&](int t, int edge) {
    return at(t) - at(edge) > 48 && (edge - t - 1) * 64 <= at(t) - at(edge);
  };
  int last = 0;
  while (x + dx * (last + 1) >= 0 && x + dx * (last + 1) < kSize && y + dy * (last + 1) >= 0 &&
         y + dy * (last + 1) < kSize) {
    ++last;
  }
  int edge = 0;
  for (int t = last - 1; t >= 0; --t) {
    const int step = at(t) - at(t + 1);
    const bool goes_on = edge != 0 && hides(t, edge) && 8 * step <= at(t) - at(edge);
    if (step > 48 && !goes_on) edge = t + 1;
  }
  return edge != 0 && hides(0, edge) ? edge : 0;
}

TEST_CASE("surfaces: hidden surfaces of random maps match an exhaustive search") {
  test::Random random(3);
  for (int round = 0; round < 20; ++round) {
    Scene scene(5);
    for (int patch = 0; patch < 30; ++patch) {
      const int x = random.Int(0, kSize - 1), y = random.Int(0, kSize - 1);
      const int right = std::min(kSize, x + random.Int(1, 12));
      const int bottom = std::min(kSize, y + random.Int(1, 12));
      // Multiples of a quarter of a pixel include steps of 3/4 pixel, which are barely too small
      // for an edge.
      const double pixels = round % 2 == 0 ? random.Real(-6, 6) : random.Int(-24, 24) / 4.0;
      scene.Fill(x, right, y, bottom, pixels, patch);
    }
    scene.Find();
    int edges = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const size_t at = scene.surfaces.At(x, y);
        CHECK(scene.edges[0][at] == Distance(scene, x, y, 1, 0));
        CHECK(scene.edges[1][at] == Distance(scene, x, y, -1, 0));
        CHECK(scene.edges[2][at] == Distance(scene, x, y, 0, 1));
        CHECK(scene.edges[3][at] == Distance(scene, x, y, 0, -1));
        edges += scene.edges[0][at] > 0;
      }
    }
    CHECK(edges > 20);
  }
}

}  // namespace
}  // namespace layered_depth_test
