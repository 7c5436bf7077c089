// SPDX-License-Identifier: Apache-2.0
// Regions of the picture: the bytes of the whole picture there, for their share of its work.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "tests/support/layered_scene.h"
#include "tests/support/test_scene.h"

namespace region_test {
namespace {

constexpr int kViews[] = {1, 5, 9, 17};

uint64_t BlocksOf(const starfocus_report& report) {
  return report.layers[0].blocks + report.layers[1].blocks + report.layers[2].blocks;
}

std::string Text(const starfocus_region& r) {
  char text[80];
  std::snprintf(text, sizeof(text), "%d,%d,%d,%d", r.x, r.y, r.width, r.height);
  return text;
}

std::vector<uint8_t> Crop(const test::Output& picture, const starfocus_region& r) {
  std::vector<uint8_t> crop;
  for (int y = r.y; y < r.y + r.height; ++y) {
    crop.insert(crop.end(), picture.Pixel(r.x, y), picture.Pixel(r.x, y) + 3 * r.width);
  }
  return crop;
}

starfocus_region RandomRegion(int width, int height, test::Random* random) {
  starfocus_region r = {random->Int(0, width - 1), random->Int(0, height - 1), 1, 1};
  if (random->Int(0, 3) == 0) return r;
  r.width = random->Int(1, width - r.x);
  r.height = random->Int(1, height - r.y);
  if (random->Int(0, 1) == 0) {
    r.width = std::min(r.width, 20);
    r.height = std::min(r.height, 20);
  }
  return r;
}

// Checks a region against the whole picture, which the same engine refocuses in between, so that
// nothing of another call may be left in what the region reads.
void CheckRegion(test::Engine* engine, const test::Scene& scene, starfocus_params params,
                 const test::Output& whole, const starfocus_report& whole_report,
                 const starfocus_region& region) {
  CAPTURE(Text(region));
  params.region = region;
  test::Output out(region.width, region.height, 5);
  starfocus_report report = {};
  REQUIRE(test::Refocus(engine, params, scene, &out, nullptr, nullptr, &report) == STARFOCUS_OK);
  const bool same = out.Tight() == Crop(whole, region);
  CHECK(same);
  CHECK(out.PaddingUntouched());
  CHECK(report.r_max == whole_report.r_max);
  CHECK(report.rendered_samples <= whole_report.rendered_samples);
  CHECK(BlocksOf(report) <= BlocksOf(whole_report));
  CHECK(BlocksOf(report) > 0);
}

void CheckRegions(const test::Scene& scene, const starfocus_config& config,
                  const starfocus_params& params, test::Random* random) {
  const int w = scene.width, h = scene.height;
  std::vector<starfocus_region> regions = {{0, 0, w, h},         {0, 0, 1, 1},
                                           {w - 1, h - 1, 1, 1}, {0, h - 1, w, 1},
                                           {w - 1, 0, 1, h},     {w / 2, h / 2, 1, 1}};
  for (int at : {32, 64, 80}) {  // on both sides of a boundary
    if (at < w && at < h) {
      regions.push_back({at, at, 1, 1});
      regions.push_back({at - 1, at - 3, 1, 1});
      regions.push_back({0, at - 8, w, 5});  // its last row is finished by the next stripe
      regions.push_back({at + 2, at - 1, w - at - 2 > 0 ? w - at - 2 : 1, 1});
      if (at + 2 >= w) regions.pop_back();
    }
  }
  for (int k = 0; k < 6; ++k) regions.push_back(RandomRegion(w, h, random));
  test::Engine engine(config);
  test::Output whole(w, h);
  starfocus_report report = {};
  REQUIRE(test::Refocus(&engine, params, scene, &whole, nullptr, nullptr, &report) == STARFOCUS_OK);
  for (const starfocus_region& region : regions) {
    CheckRegion(&engine, scene, params, whole, report, region);
  }
}

TEST_CASE("region: the bytes of the whole picture, in every mode") {
  test::Random random(71);
  for (int round = 0; round < 40; ++round) {
    const int width = random.Int(1, 180), height = random.Int(1, 150);
    const test::Scene scene =
        test::LayeredScene(width, height, kViews[round % 4], 7, uint64_t(round) + 700);
    starfocus_config config = test::ConfigFor(scene, 20);
    config.superblock = 32 << random.Int(0, 2);
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    config.tuning.deblocking = random.Int(0, 2) == 0 ? random.Int(0, 255) : 255;
    starfocus_params params =
        test::Params(random.Real(-9, 9), random.Real(0.3, 1), STARFOCUS_MODE_BLOCK);
    params.renderer = random.Int(0, 2);
    if (round % 4 == 3) params.mode = round % 8 == 3 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLUR;
    if (round == 11) params.mode = STARFOCUS_MODE_BENCHMARK;
    CAPTURE(round);
    CheckRegions(scene, config, params, &random);
  }
}

TEST_CASE("region: joins between blocks of different layers reach into it") {
  // Layers 0 and 2 side by side, whatever the pixels.
  test::Random random(72);
  for (const int side : {32, 64}) {
    test::Scene scene = test::LayeredScene(160, 160, 5, 12, 5);
    for (int y = 0; y < 160; ++y) {
      for (int x = 0; x < 160; ++x) {
        scene.Disparity(x, y) = (x / side + y / side) % 2 == 0 ? 0.0f : 11.0f;
      }
    }
    starfocus_config config = test::ConfigFor(scene, 13);
    config.superblock = side;
    config.tuning.deblocking = 255;
    starfocus_params params = test::Params(-1, 1, STARFOCUS_MODE_BLOCK);
    params.renderer = STARFOCUS_RENDERER_LINE_SCAN;
    CheckRegions(scene, config, params, &random);
  }
}

TEST_CASE("region: costs its share of the picture and its surroundings") {
  const test::Scene scene = test::LayeredScene(640, 640, 5, 4, 9);
  starfocus_config config = test::ConfigFor(scene, 8);
  config.superblock = 32;
  test::Engine engine(config);
  for (const starfocus_mode mode : {STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_FRAME}) {
    starfocus_params params = test::Params(1, 1, mode);
    test::Output whole(640, 640), out(20, 20);
    starfocus_report report = {}, part = {};
    REQUIRE(test::Refocus(&engine, params, scene, &whole, nullptr, nullptr, &report) ==
            STARFOCUS_OK);
    int told = 0;
    const starfocus_callbacks counts = test::VisitedBy(
        [](void* data, const starfocus_block*) { ++*static_cast<int*>(data); }, &told);
    params.region = {326, 326, 20, 20};  // inside one superblock
    REQUIRE(test::Refocus(&engine, params, scene, &out, counts, &part) == STARFOCUS_OK);
    CHECK(BlocksOf(part) == uint64_t(told));
    CHECK(BlocksOf(part) <= 4);
    CHECK(part.rendered_samples * 100 < report.rendered_samples);
    params.region = {319, 319, 2, 2};  // where four meet
    REQUIRE(test::Refocus(&engine, params, scene, &out, nullptr, nullptr, &part) == STARFOCUS_OK);
    CHECK(BlocksOf(part) == 4);
  }
}

TEST_CASE("region: only disparity rows that it can read are checked, before a pixel is written") {
  test::Scene scene = test::LayeredScene(40, 600, 1, 4, 3);
  starfocus_config config = test::ConfigFor(scene, 4);
  config.superblock = 32;
  test::Engine engine(config);
  REQUIRE(engine.status() == STARFOCUS_OK);
  starfocus_params params = test::Params(0, 1, STARFOCUS_MODE_BLOCK);
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

TEST_CASE("region: a bad row is refused before a pixel is written, or is not read") {
  constexpr int kHeight = 240;
  test::Scene scene = test::LayeredScene(40, kHeight, 5, 3, 4);
  starfocus_config config = test::ConfigFor(scene, 4);
  config.superblock = 32;
  config.features &= ~STARFOCUS_FEATURE_COVERAGE;  // which comes from farther away
  test::Engine engine(config);
  constexpr starfocus_region kRegions[] = {
      {0, 0, 0, 0}, {3, 0, 30, 9}, {3, 70, 30, 9}, {0, 120, 40, 50}, {3, 231, 30, 9}};
  for (const starfocus_mode mode :
       {STARFOCUS_MODE_FRAME, STARFOCUS_MODE_BLOCK, STARFOCUS_MODE_BLUR}) {
    for (const starfocus_region& region : kRegions) {
      CAPTURE(mode);
      CAPTURE(Text(region));
      starfocus_params params = test::Params(0, 1, mode);
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
