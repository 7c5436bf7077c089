// SPDX-License-Identifier: Apache-2.0
// Checks that all ways to request a picture return the bytes of the whole picture.
#include "tests/support/ways.h"

#include <doctest/doctest.h>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/layered_scene.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace ways_test {
namespace {

TEST_CASE(
    "ways: every way to refocus returns the bytes of the whole picture for many lenses and modes") {
  constexpr int kViews[] = {1, 5, 9, 17};
  constexpr int kSizes[][2] = {{1, 1},    {1, 130},  {130, 1},  {31, 33},   {64, 64},  {65, 63},
                               {100, 37}, {67, 260}, {200, 90}, {129, 128}, {97, 131}, {150, 66}};
  test::Random random(71);
  for (int round = 0; round < test::Rounds(60); ++round) {
    CAPTURE(round);
    const auto& size = kSizes[random.Int(0, 11)];
    const bool any = random.Int(0, 1) == 0;
    const int width = any ? random.Int(1, 180) : size[0],
              height = any ? random.Int(1, 150) : size[1];
    const test::Scene scene =
        test::LayeredScene(width, height, kViews[random.Int(0, 3)], 7, uint64_t(round) + 700);
    test::Config config = test::ConfigFor(scene, 20);
    config.superblock = 32 << random.Int(0, 3);
    config.tuning.max_layer = random.Int(0, 3) == 0 ? random.Int(0, 1) : 2;
    config.tuning.deblocking = random.Int(0, 2) == 0 ? random.Int(0, 255) : 255;
    starfocus::Params params =
        test::Params(random.Real(-12, 12), random.Real(0.3, 1), STARFOCUS_MODE_BLOCK);
    params.study.renderer = random.Int(0, 2);
    if (round % 4 == 3)
      params.study.mode = round % 8 == 3 ? STARFOCUS_MODE_FRAME : STARFOCUS_MODE_BLUR;
    if (round == 11) params.study.mode = STARFOCUS_MODE_BENCHMARK;
    if (round % 3 == 0) params.focus_nearer = random.Real(0, 6);
    if (round % 5 == 0) params.focus_farther = random.Real(0, 6);
    test::CheckWays(scene, config, params, true);
  }
}

}  // namespace
}  // namespace ways_test
