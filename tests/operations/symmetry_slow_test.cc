// SPDX-License-Identifier: Apache-2.0
// Tests that mirroring, transposing or rotating the light field mirrors, transposes or rotates the
// refocused picture, if the picture consists of whole blocks. The pictures must be equal byte for
// byte, except for rotations with wide subapertures.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/symmetry.h"
#include "tests/support/test_scene.h"

namespace symmetry_slow_test {
namespace {

using test::Distance;

struct Symmetry {
  const char* name;
  test::Symmetry move;
};

const Symmetry kMirrors[] = {{"mirror x", {false, true, false}},
                             {"mirror y", {false, false, true}},
                             {"turn 180", {false, true, true}}};
const Symmetry kTurns[] = {{"transpose", {true, false, false}},
                           {"turn 90", {true, true, false}},
                           {"turn 270", {true, false, true}},
                           {"anti-transpose", {true, true, true}}};

TEST_CASE("symmetry: mirroring or rotating a light field permutes the positions of its views") {
  CHECK(test::MoveView(kMirrors[0].move, 1) == 2);
  CHECK(test::MoveView(kMirrors[0].move, 3) == 3);
  CHECK(test::MoveView(kMirrors[1].move, 3) == 4);
  CHECK(test::MoveView(kTurns[0].move, 1) == 3);
  for (const Symmetry& s : {kMirrors[2], kTurns[1], kTurns[3]}) {
    std::vector<int> places;
    for (int view = 0; view < STARFOCUS_MAX_VIEWS; ++view)
      places.push_back(test::MoveView(s.move, view));
    std::sort(places.begin(), places.end());
    for (int view = 0; view < STARFOCUS_MAX_VIEWS; ++view) CHECK(places[size_t(view)] == view);
  }
}

test::Output Refocused(const test::Scene& scene, const starfocus::Params& params) {
  test::Config config = test::ConfigFor(scene);
  config.superblock = 32;
  // Layers 1 and 2 are not symmetric, since they keep every second pixel from the left and the top.
  config.tuning.max_layer = 0;
  const test::Output out = test::OutputOf(config, params, scene);
  return out;
}

Distance Measure(const Symmetry& s, const test::Scene& scene, const starfocus::Params& params) {
  const test::Output plain = Refocused(scene, params);
  CHECK(plain.bytes != scene.pictures[0]);
  const test::Output moved = Refocused(test::Move(s.move, scene), params);
  return test::Compare(s.move, scene.width, scene.height, plain.bytes.data(), moved.bytes.data());
}

void Check(const Symmetry& s, const test::Scene& scene, const starfocus::Params& params) {
  CAPTURES(s.name, scene.width, scene.height, scene.views(), params.focus);
  CHECK(Measure(s, scene, params).samples == 0);
}

constexpr int kSizes[][2] = {{32, 32}, {64, 64}, {96, 32}, {64, 128}};

TEST_CASE("symmetry: mirrored light fields give mirrored pictures") {
  for (const auto& size : kSizes) {
    for (int views : {17, 9, 5, 1}) {
      const test::Scene scene = test::RandomScene(size[0], size[1], views, -4, 4, 31);
      for (const Symmetry& s : kMirrors) {
        Check(s, scene, test::Params(0));
        Check(s, scene, test::Params(-3.3, 0.7));
      }
    }
  }
}

TEST_CASE("symmetry: transposed and rotated light fields give transposed and rotated pictures") {
  for (const auto& size : kSizes) {
    for (int views : {17, 9, 5, 1}) {
      const test::Scene scene = test::RandomScene(size[0], size[1], views, -4, 4, 32);
      for (const Symmetry& s : kTurns) {
        for (starfocus::Params params : {test::Params(0), test::Params(2.6, 0.9)}) {
          // The test uses the line scan, since slices are moved along rows first and are not
          // exactly symmetric.
          params.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;
          Check(s, scene, params);
        }
      }
    }
  }
}

TEST_CASE("symmetry: benchmark pictures of noisy disparities are symmetric") {
  test::Scene scene = test::RandomScene(64, 32, 17, -2, 3, 33);
  test::Random random(34);
  test::NoisyDisparity(&scene, &random);
  for (const Symmetry& s : kMirrors)
    Check(s, scene, test::Params(0.4, 1, STARFOCUS_MODE_BENCHMARK));
  starfocus::Params lines =
      test::Params(0.4, 1, STARFOCUS_MODE_BENCHMARK, STARFOCUS_RENDERER_LINE_SCAN);
  for (const Symmetry& s : kMirrors) Check(s, scene, lines);
  for (const Symmetry& s : kTurns) Check(s, scene, lines);
}

// The subapertures are up to several pixels wide, and the surfaces are flat, slanted and noisy.
TEST_CASE(
    "symmetry: with wide subapertures, mirrored light fields give exactly mirrored pictures") {
  for (const int views : {17, 5, 1}) {
    test::Scene scene = test::RandomScene(64, 32, views, -3, 8, 35);
    test::Random random(36);
    for (const bool noisy : {false, true}) {
      if (noisy) test::NoisyDisparity(&scene, &random);
      for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
        starfocus::Params params = test::Params(-12.6, 1, mode, STARFOCUS_RENDERER_SLICES);
        for (const Symmetry& s : kMirrors) Check(s, scene, params);
      }
    }
  }
}

// With wide subapertures, all views are rendered along rows first. On a single surface, the order
// of rows and columns affects only the rounding. Next to a depth edge, the order of rows and
// columns determines which surface is visible.
TEST_CASE("symmetry: with wide subapertures, rotated light fields give nearly rotated pictures") {
  for (const int views : {17, 5, 1}) {
    for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
      for (const double focus : {-12.6, 1.3}) {
        starfocus::Params params = test::Params(focus, 1, mode, STARFOCUS_RENDERER_SLICES);
        for (const Symmetry& s : kTurns) {
          CAPTURES(s.name, views, mode, focus);
          test::Scene flat = test::RandomScene(64, 32, views, 3, 3, 37);
          const Distance one = Measure(s, flat, params);
          CHECK(one.largest <= 1);
          CHECK(one.mean < 0.06);
          const Distance many = Measure(s, test::RandomScene(64, 32, views, -3, 8, 35), params);
          CHECK(many.mean < 2);
        }
      }
    }
  }
}

}  // namespace
}  // namespace symmetry_slow_test
