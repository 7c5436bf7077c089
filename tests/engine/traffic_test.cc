// SPDX-License-Identifier: Apache-2.0
// What starfocus_report tells of bytes read of the light field.
#include <doctest/doctest.h>

#include <cstdint>

#include "starfocus/starfocus.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace traffic_test {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// Noise at one disparity.
test::Scene FlatScene(float disparity) {
  test::Random random(3);
  test::Scene scene = test::EmptyScene(kWidth, kHeight, 5, -4, 4);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), &random);
  for (float& d : scene.disparity) d = disparity;
  return scene;
}

starfocus_config Config(const test::Scene& scene) {
  starfocus_config config = test::ConfigFor(scene, 8);
  config.superblock = 64;
  return config;
}

TEST_CASE("traffic: what is in focus is read once") {
  const test::Scene scene = FlatScene(0.1f);
  const starfocus_report report =
      test::RefocusScene(scene, Config(scene), test::Params(0, 0.3, STARFOCUS_MODE_BLOCK)).report;
  CHECK(report.skipped.copied_pixels == kWidth * kHeight);
  CHECK(report.centre_bytes == 3 * kWidth * kHeight);
  CHECK(report.disparity_bytes == 2 * 4 * kWidth * kHeight);
  CHECK(report.side_bytes == 0);
}

TEST_CASE("traffic: blocks are read with what lies around them") {
  const test::Scene scene = FlatScene(0.1f);
  starfocus_params params = test::Params(0, 0.75, STARFOCUS_MODE_FRAME);
  params.renderer = STARFOCUS_RENDERER_SLICES;
  const starfocus_report report = test::RefocusScene(scene, Config(scene), params).report;
  // Blocks of 64 and 32 by 64 with the border of blur radius 3: that many columns lie in the
  // picture, and that many rows are read, of which the picture's edges repeat.
  constexpr int kBorder = 5, kRows = kHeight + 2 * kBorder;
  CHECK(report.centre_bytes == 3 * kRows * (64 + kBorder + 32 + kBorder));
  CHECK(report.disparity_bytes == 2 * 4 * kWidth * kHeight);
}

TEST_CASE("traffic: of a map in focus at disparity 4 side views are read beyond the edges only") {
  const test::Scene scene = FlatScene(4);
  starfocus_params params = test::Params(3, 1, STARFOCUS_MODE_FRAME);
  params.renderer = STARFOCUS_RENDERER_SLICES;
  const starfocus_report report = test::RefocusScene(scene, Config(scene), params).report;
  // 4 of the pixels beyond each edge, beside each block, by 2 x 2 pixels of 3 bytes.
  constexpr uint64_t kAlong = 2 * (kWidth + 2 * 9) + 2 * kHeight;
  CHECK(report.side_bytes == 12 * 4 * kAlong);
}

TEST_CASE("traffic: the map is read twice, first to be checked, and that of a stream once") {
  constexpr int kTall = 700;
  const test::Scene scene = test::RandomScene(kWidth, kTall, 5, -4, 4, 6);
  starfocus_config config = Config(scene);
  starfocus_params params = test::Params(0, 0.75, STARFOCUS_MODE_BLOCK);
  const starfocus_report whole = test::RefocusScene(scene, config, params).report;
  CHECK(whole.disparity_bytes == 2 * 4 * kWidth * kTall);
  // Of a region, rows that its blocks may read.
  params.region = {0, 330, kWidth, 40};
  const starfocus_report part = test::RefocusScene(scene, config, params).report;
  CHECK(part.disparity_bytes > 0);
  CHECK(part.disparity_bytes < whole.disparity_bytes);
  // Rows of a stream are checked one by one.
  params.region = {};
  config.features |= STARFOCUS_FEATURE_STREAMING;
  test::Engine engine(config);
  test::Output out(kWidth, kTall);
  starfocus_report streamed = {};
  REQUIRE(test::Stream(&engine, params, scene, &out, 50, 50, nullptr, nullptr, &streamed) ==
          STARFOCUS_OK);
  CHECK(streamed.disparity_bytes == 4 * kWidth * kTall);
}

TEST_CASE("traffic: layers read the centre view once more") {
  const test::Scene scene = FlatScene(0.1f);
  starfocus_config config = test::ConfigFor(scene, 24);
  config.superblock = 64;
  config.tuning.gather = 0;
  const starfocus_params params = test::Params(18, 1, STARFOCUS_MODE_BLOCK);
  const starfocus_report layered = test::RefocusScene(scene, config, params).report;
  config.tuning.max_layer = 0;
  const starfocus_report whole = test::RefocusScene(scene, config, params).report;
  CHECK(layered.layers[0].pixels == 0);
  CHECK(layered.centre_bytes >= 3 * kWidth * kHeight);
  CHECK(layered.centre_bytes < whole.centre_bytes);
}

}  // namespace
}  // namespace traffic_test
