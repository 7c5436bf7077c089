// SPDX-License-Identifier: Apache-2.0
// Compares the engine with the double-precision reference. Samples must differ by at most one grey
// level.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/conformance/conformance.h"
#include "tests/conformance/reference.h"
#include "tests/support/config.h"
#include "tests/support/error_line.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace conformance_slow_test {
namespace {

using namespace conformance;

// Refocuses with the engine and the reference, and checks their distance.
Distance Check(const test::Scene& scene, const starfocus::Params& params,
               const test::Config& config) {
  const int block = config.superblock;
  test::Engine engine(config);
  test::Output out(scene.width, scene.height);
  starfocus_report report = starfocus::NewReport();
  REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &report) == STARFOCUS_OK);
  const reference::Result expected = reference::Refocus(scene, params, config, block);
  CAPTURE(TextOf(scene, params, config));
  CHECK(report.n == expected.n);
  CHECK(report.rendered_views == expected.views);
  const Distance distance = Compare(out.Tight(), expected.rgb);
  CHECK(distance.largest <= 1);
  if (distance.samples >= kEnoughSamples) CHECK(distance.mean() < kMeanLimit);
  return distance;
}

// Checks the line scan with both transfer functions. block_conformance_slow_test checks slices.
Distance Check(const test::Scene& scene, starfocus::Params params, int block, double theta) {
  params.study.renderer = STARFOCUS_RENDERER_LINE_SCAN;
  test::Config config = test::ConfigFor(scene, 16);
  config.superblock = block;
  params.theta = theta;
  Distance all;
  for (const starfocus_transfer transfer : {STARFOCUS_TRANSFER_NONE, STARFOCUS_TRANSFER_SRGB}) {
    config.transfer = transfer;
    all.Add(Check(scene, params, config));
  }
  return all;
}

Distance Check(const test::Scene& scene, const starfocus::Params& params, int block = 32) {
  return Check(scene, params, block, 0.26 * 3.14159265358979323846);
}

// Widths and heights of the random scenes. The scenes are small, because the reference is slow.
constexpr int kSizes[][2] = {{1, 1}, {7, 5}, {40, 33}, {96, 64}};
// Returns parameters with a random lens whose largest blur radius is r_max.
starfocus::Params RandomLens(const test::Scene& scene, starfocus_mode mode, double r_max,
                             test::Random* random) {
  const double aperture = random->Int(0, 2) == 0 ? 1 : random->Real(0.3, 1);
  const double reach = r_max / aperture;
  const double half = 0.5 * double(scene.disparity_max - scene.disparity_min);
  const double centre = 0.5 * double(scene.disparity_min + scene.disparity_max);
  const double offset = std::max(0.0, reach - half);
  return test::Params(centre + (random->Int(0, 1) == 0 ? offset : -offset), aperture, mode);
}

TEST_CASE(
    "conformance: random scenes with every star set match the reference in frame and benchmark "
    "mode") {
  Distance all[2];
  for (const starfocus_mode mode : {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BENCHMARK}) {
    test::Random random(41 + uint64_t(mode));
    for (const auto& size : kSizes) {
      for (const int views : kStars) {
        for (const Depth depth : kDepths) {
          const double low = random.Real(-4, 3);
          const Range range = {float(low), float(low + random.Real(0.5, 5))};
          const test::Scene scene = MakeScene(size[0], size[1], views, range, depth, &random);
          const double r_max = mode == STARFOCUS_MODE_FRAME ? random.Real(2, 9) : random.Real(1, 5);
          all[mode].Add(Check(scene, RandomLens(scene, mode, r_max, &random)));
        }
      }
    }
  }
  all[STARFOCUS_MODE_FRAME].Print("random scenes, frame");
  all[STARFOCUS_MODE_BENCHMARK].Print("random scenes, benchmark");
  CHECK(all[STARFOCUS_MODE_FRAME].mean() < kMeanLimit);
  CHECK(all[STARFOCUS_MODE_BENCHMARK].mean() < kMeanLimit);
}

TEST_CASE("conformance: many small scenes match the reference") {
  constexpr int kSmall = 36;
  Distance all;
  for (uint64_t seed = 0; seed < (test::kSlow ? 100 : 300); ++seed) {
    test::Random random(1000 + seed);
    const double low = random.Real(-6, 5);
    const Range range = {float(low), float(low + random.Real(0, 7))};
    const test::Scene scene =
        MakeScene(random.Int(1, kSmall), random.Int(1, kSmall), kStars[random.Int(0, 3)], range,
                  kDepths[random.Int(0, 3)], &random);
    const starfocus_mode mode =
        random.Int(0, 3) == 0 ? STARFOCUS_MODE_BENCHMARK : STARFOCUS_MODE_FRAME;
    const double r_max = mode == STARFOCUS_MODE_FRAME ? random.Real(0.1, 9) : random.Real(0.1, 4);
    CAPTURE(seed);
    all.Add(Check(scene, RandomLens(scene, mode, r_max, &random)));
  }
  all.Print("small scenes");
  CHECK(all.mean() < kMeanLimit);
}

TEST_CASE(
    "conformance: blocks of 64 pixels match the reference at the widest and narrowest aperture") {
  Distance all;
  for (const double theta : {STARFOCUS_MIN_THETA, STARFOCUS_MAX_THETA}) {
    for (const int views : kStars) {
      test::Random random(77 + uint64_t(views));
      const test::Scene scene = MakeScene(96, 64, views, {-2, 3}, Depth::kPiecewise, &random);
      all.Add(Check(scene, test::Params(0.7), 64, theta));
      all.Add(Check(scene, test::Params(-1.9, 0.8), 64, theta));
    }
  }
  all.Print("blocks of 64");
}

#ifdef STARFOCUS_PROGRAM
TEST_CASE("conformance: parts of the data set wires match the reference" *
          doctest::test_suite("data_sets")) {
  const std::string folder = test::DataSet("wires");
  if (folder.empty()) return;
  starfocus::LightField field = starfocus::ValueOf(starfocus::LoadLightField(folder, {}));
  Distance all;
  for (const int x : {0, 192, 384}) {
    const test::Scene scene = Crop(field, x, 128, 128, 128);
    for (const double focus : {0.0, 3.0, 7.0}) all.Add(Check(scene, test::Params(focus), 64));
  }
  const test::Scene scene = Crop(field, 200, 100, 64, 64);
  all.Add(Check(scene, test::Params(3, 1, STARFOCUS_MODE_BENCHMARK), 64));
  all.Print("wires");
}
#endif

}  // namespace
}  // namespace conformance_slow_test
