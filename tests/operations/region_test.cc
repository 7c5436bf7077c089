// SPDX-License-Identifier: Apache-2.0
// Tests regions of the picture. A refocused region must equal the same pixels of the whole picture,
// and only pixels near the region may be rendered.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"
#include "tests/support/ways.h"

namespace region_test {
namespace {

std::string Text(const starfocus_region& r) {
  char text[80];
  std::snprintf(text, sizeof(text), "%d,%d,%d,%d", r.x, r.y, r.width, r.height);
  return text;
}

TEST_CASE("region: boundaries outside the region are deblocked if they affect pixels inside") {
  // Blocks at layers 0 and 2 are adjacent, whatever the colours of the pixels are.
  for (const int side : {32, 64}) {
    test::Scene scene = test::LayeredScene(160, 160, 5, 12, 5);
    test::SetDisparity(&scene,
                       [&](int x, int y) { return (x / side + y / side) % 2 == 0 ? 0.0f : 11.0f; });
    test::Config config = test::ConfigFor(scene, 13);
    config.superblock = side;
    config.tuning.deblocking = 255;
    starfocus::Params params =
        test::Params(-1, 1, STARFOCUS_MODE_BLOCK, STARFOCUS_RENDERER_LINE_SCAN);
    test::CheckWays(scene, config, params, true);
  }
}

TEST_CASE("region: only the region and its surroundings are rendered") {
  const test::Scene scene = test::LayeredScene(640, 640, 5, 4, 9);
  test::Config config = test::ConfigFor(scene, 8);
  config.superblock = 32;
  test::Engine engine(config);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
    starfocus::Params params = test::Params(1, 1, mode);
    test::Output out(20, 20);
    test::Report report, part;
    const test::Output whole = test::OutputOf(&engine, params, scene, &report);
    int told = 0;
    const starfocus_observer observer = test::Visitor(
        [](void* data, const starfocus_block*) { ++*static_cast<int*>(data); }, &told);
    const starfocus_callbacks counts = test::ObservedBy(&observer);
    params.region = {326, 326, 20, 20};  // inside one superblock
    REQUIRE(test::Refocus(&engine, params, scene, &out, counts, &part) == STARFOCUS_OK);
    CHECK(test::BlocksOf(part) == uint64_t(told));
    CHECK(test::BlocksOf(part) <= 4);
    CHECK(part.rendered_samples * 100 < report.rendered_samples);
    params.region = {319, 319, 2, 2};  // Four superblocks meet in this region.
    REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &part) == STARFOCUS_OK);
    CHECK(test::BlocksOf(part) == 4);
  }
}

TEST_CASE(
    "region: only disparities within the reach of the region are checked, before pixels are "
    "written") {
  test::Scene scene = test::LayeredScene(40, 600, 1, 4, 3);
  test::Config config = test::ConfigFor(scene, 4);
  config.superblock = 32;
  test::Engine engine(config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  starfocus::Params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK);
  params.region = {0, 290, 40, 20};
  test::Output out(40, 20);
  for (const int far : {0, 120, 480, 599}) {
    scene.Disparity(7, far) = std::numeric_limits<float>::quiet_NaN();
  }
  CHECK(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
  for (const int near : {286, 300, 312, 330}) {
    test::Output untouched(40, 20);
    const float good = scene.Disparity(7, near);
    scene.Disparity(7, near) = 4.5f;
    CHECK(test::Refocus(&engine, params, scene, &untouched) == STARFOCUS_ERROR_DISPARITY);
    CHECK(untouched.Untouched());
    scene.Disparity(7, near) = good;
  }
}

TEST_CASE("region: each row with a bad disparity is either rejected before output or never read") {
  constexpr int kHeight = 240;
  test::Scene scene = test::LayeredScene(40, kHeight, 5, 3, 4);
  test::Config config = test::ConfigFor(scene, 4);
  config.superblock = 32;
  // The search for coverage would read rows that are farther away from the region.
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;
  test::Engine engine(config);
  constexpr starfocus_region kRegions[] = {
      {0, 0, 0, 0}, {3, 0, 30, 9}, {3, 70, 30, 9}, {0, 120, 40, 50}, {3, 231, 30, 9}};
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
    for (const starfocus_region& region : kRegions) {
      CAPTURES(mode, Text(region));
      starfocus::Params params = test::Params(0, 1, mode);
      params.region = region;
      const test::Output blank(region.width > 0 ? region.width : 40,
                               region.width > 0 ? region.height : kHeight);
      test::Output good = blank;
      REQUIRE(test::Refocus(&engine, params, scene, &good) == STARFOCUS_OK);
      int refused = 0;
      for (int row = 0; row < kHeight; ++row) {
        test::Output out = blank;
        const float kept = scene.Disparity(5, row);
        scene.Disparity(5, row) = std::numeric_limits<float>::quiet_NaN();
        const starfocus_status status = test::Refocus(&engine, params, scene, &out);
        scene.Disparity(5, row) = kept;
        refused += status == STARFOCUS_ERROR_NOT_FINITE;
        const bool right = status == STARFOCUS_OK
                               ? out.bytes == good.bytes
                               : status == STARFOCUS_ERROR_NOT_FINITE && out.Untouched();
        CHECK_MESSAGE(right, "row ", row);
      }
      CHECK(refused >= good.height);
      CHECK((refused < kHeight || region.width == 0));
    }
  }
}

}  // namespace
}  // namespace region_test
