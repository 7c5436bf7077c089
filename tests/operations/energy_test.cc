// SPDX-License-Identifier: Apache-2.0
// Tests that the mean brightness is unchanged if every rendered view is shifted by half a pixel.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "tests/support/config.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace energy_test {
namespace {

constexpr int kPeriod = 16, kMargin = 24, kSide = kPeriod + 2 * kMargin;

// Returns periodic noise. The right half of each period is the left half, inverted around the level
// `mean`.
test::Scene PeriodicScene(int mean, uint64_t seed) {
  test::Random random(seed);
  test::Scene scene = test::EmptyScene(kSide, kSide, 1, 0, 0);
  int pattern[kPeriod][kPeriod];
  for (auto& row : pattern) {
    for (int x = 0; x < kPeriod / 2; ++x) {
      row[x] = mean + random.Int(-60, 60);
      row[x + kPeriod / 2] = 2 * mean - row[x];
    }
  }
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      std::fill_n(scene.Pixel(0, x, y), 3, uint8_t(pattern[y % kPeriod][x % kPeriod]));
    }
  }
  return scene;
}

TEST_CASE("energy: views shifted by half a pixel do not change the mean brightness") {
  for (const starfocus_mode mode : test::kModes) {
    for (const double radius : {0.5, 1.0, 1.5, 3.03125, 4.5, 6.25}) {
      double sum = 0;
      constexpr int kRounds = 40;
      for (int round = 0; round < kRounds; ++round) {
        const int mean = 108 + round;
        const test::Scene scene = PeriodicScene(mean, uint64_t(round) + 1);
        test::Config config = test::ConfigFor(scene, 7);
        config.transfer = STARFOCUS_TRANSFER_NONE;
        const test::Output out = test::OutputOf(config, test::Params(radius, 1, mode), scene);
        for (int y = kMargin; y < kMargin + kPeriod; ++y) {
          for (int x = kMargin; x < kMargin + kPeriod; ++x) sum += *out.Pixel(x, y) - mean;
        }
      }
      CAPTURES(mode, radius);
      CHECK(std::abs(sum / (kRounds * kPeriod * kPeriod)) < 0.02);
    }
  }
}

}  // namespace
}  // namespace energy_test
