// SPDX-License-Identifier: Apache-2.0
// Tests that a refocused picture does not depend on the amount of reserved memory. Memory that a
// configuration reserves for other lenses must not change a byte of the picture.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/rounds.h"
#include "tests/support/test_scene.h"

namespace room_bytes_test {
namespace {

// Returns a scene of a few disparities, chosen at random for each pixel. The scene requires more
// slices than the memory holds.
test::Scene Levels(int side, int count, float range, test::Random* random) {
  test::Scene scene = test::EmptyScene(side, side, random->Int(0, 1) == 0 ? 1 : 5, -range, range);
  for (auto& picture : scene.pictures) picture = test::RandomBytes(picture.size(), random);
  std::vector<float> levels(static_cast<size_t>(count));
  for (float& level : levels) level = static_cast<float>(random->Real(-range, range));
  for (float& disparity : scene.disparity) {
    disparity = levels[static_cast<size_t>(random->Int(0, count - 1))];
  }
  return scene;
}

std::vector<uint8_t> Picture(const test::Config& config, const starfocus::Params& params,
                             const test::Scene& scene) {
  test::Engine engine(config);
  test::Output out(scene.width, scene.height);
  if (test::Has(config.features, STARFOCUS_FEATURE_STREAMING)) {
    REQUIRE(test::Stream(&engine, params, scene, &out, 7, 5) == STARFOCUS_OK);
  } else {
    REQUIRE(test::Refocus(&engine, params, scene, &out) == STARFOCUS_OK);
  }
  return out.Tight();
}

TEST_CASE(
    "workspace: space for larger blurs, more rows or more workers does not change the picture") {
  test::Random random(11);
  for (int round = 0; round < test::Rounds(60); ++round) {
    const float range = static_cast<float>(random.Real(2, 40));
    const int side = random.Int(0, 2) == 0 ? 96 : 32 << random.Int(0, 1);
    const test::Scene scene = Levels(side, random.Int(5, 16), range, &random);
    starfocus::Params params =
        test::Params(0, 1, random.Int(0, 1) == 0 ? STARFOCUS_MODE_BLOCK : STARFOCUS_MODE_FRAME);
    if (range < 5 && random.Int(0, 1) == 0) params.study.mode = STARFOCUS_MODE_BENCHMARK;
    params.study.renderer =
        random.Int(0, 5) == 0 ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_SLICES;
    test::Config config = test::ConfigFor(scene, double{range});
    config.superblock = 32 << random.Int(0, 1);
    config.tuning.n_scale = random.Int(0, 1) == 0 ? 0.5 : 1;
    config.tuning.timing.block = 1u << random.Int(0, 26);
    config.tuning.gather = random.Int(0, 1);
    const std::vector<uint8_t> expected = Picture(config, params, scene);
    for (const double max_blur : {range + 1.0, 45.0, STARFOCUS_MAX_BLUR}) {
      test::Config other = config;
      other.max_blur = max_blur;
      test::SetFeature(STARFOCUS_FEATURE_STREAMING, random.Int(0, 1), &other.features);
      other.max_workers = random.Int(1, 3);
      CAPTURES(round, max_blur);
      CHECK((Picture(other, params, scene) == expected));
    }
  }
}

}  // namespace
}  // namespace room_bytes_test
