// SPDX-License-Identifier: Apache-2.0
// Tests that maps with unknown values are either rejected or filled along rows.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace fill_unknown_bytes_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A scene with partly unknown disparities, and this scene with the expected filled disparities.
struct Scenes {
  test::Scene unknown, filled;
  int64_t count = 0;

  Scenes(int width, int height, int views, uint64_t seed)
      : unknown(test::RandomScene(width, height, views, -3, 3, seed)), filled(unknown) {}

  // Makes the disparities of columns [first, end) of row y unknown. The expected filled disparity
  // is `value`.
  void Forget(int y, int first, int end, float value, float as = kNaN) {
    for (int x = first; x < end; ++x) {
      unknown.Disparity(x, y) = as;
      filled.Disparity(x, y) = value;
    }
    count += end - first;
  }
};

// Makes gaps at both ends, gaps in the middle with the farther surface on either side, and an
// unknown row.
Scenes WithGaps(int views) {
  Scenes scenes(150, 90, views, 5);
  for (int y = 3; y < 90; y += 7) {
    const auto at = [&](int x) { return scenes.filled.Disparity(x, y); };
    scenes.Forget(y, 0, 9, at(9));
    scenes.Forget(y, 40, 63, std::min(at(39), at(63)), y % 2 == 0 ? kInfinity : -kInfinity);
    scenes.Forget(y, 141, 150, at(140));
  }
  scenes.Forget(50, 0, 150, scenes.unknown.disparity_min);
  return scenes;
}

test::Config FillingConfig(const test::Scene& scene) {
  test::Config config = test::ConfigFor(scene, 32);
  config.unknown = STARFOCUS_UNKNOWN_FILL;
  return config;
}

TEST_CASE("fill unknown: in every mode, gaps get the farther known value of the row") {
  for (const int views : {1, 5}) {
    const Scenes scenes = WithGaps(views);
    for (const starfocus_mode mode : test::kModes) {
      const starfocus::Params params = test::Params(0.5, 0.5, mode);
      const test::Refocused filled =
          test::RefocusScene(scenes.unknown, FillingConfig(scenes.unknown), params);
      const test::Refocused by_hand =
          test::RefocusScene(scenes.filled, test::ConfigFor(scenes.filled, 32), params);
      CAPTURES(views, mode);
      CHECK(filled.rgb == by_hand.rgb);
      CHECK(filled.report.unknown_pixels == uint64_t(scenes.count));
      CHECK(by_hand.report.unknown_pixels == 0);
    }
  }
}

TEST_CASE(
    "fill unknown: values out of range, and unknown values without the option, are rejected") {
  Scenes scenes = WithGaps(1);
  const auto status = [&](const test::Config& config) {
    test::Engine engine(config);
    test::Output out(scenes.unknown.width, scenes.unknown.height);
    const starfocus::Params params = test::Params(0, 0.5, STARFOCUS_MODE_BLOCK);
    const starfocus_status found = test::Refocus(&engine, params, scenes.unknown, &out);
    CHECK(out.Untouched());
    return found;
  };
  CHECK(status(test::ConfigFor(scenes.unknown, 32)) == STARFOCUS_ERROR_NOT_FINITE);
  // The rejected value lies next to unknown values.
  scenes.unknown.Disparity(70, 10) = scenes.unknown.disparity_max + 1;
  CHECK(status(FillingConfig(scenes.unknown)) == STARFOCUS_ERROR_DISPARITY);
}

}  // namespace
}  // namespace fill_unknown_bytes_test
