// SPDX-License-Identifier: Apache-2.0
// Tests the borders that the engine plans for blocks: each block is refocused with this border and
// with wider borders. For one flat surface, a wider border may not change any block. At gaps
// between surfaces, which may be filled with colours from beyond the border, small changes are
// allowed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/refocused.h"
#include "tests/support/test_scene.h"

namespace refocus_block_test {
namespace {

using starfocus::Block;

test::Scene NoiseScene(int width, int height, int views, float limit, test::Random* random) {
  test::Scene scene = test::EmptyScene(width, height, views, -limit, limit);
  for (auto& picture : scene.pictures) {
    for (uint8_t& sample : picture) sample = random->Byte();
  }
  return scene;
}

test::Scene FlatScene(int width, int height, int views, float limit, test::Random* random) {
  test::Scene scene = NoiseScene(width, height, views, limit, random);
  const float d = static_cast<float>(random->Int(-64, 64)) / 64 * limit;
  std::fill(scene.disparity.begin(), scene.disparity.end(), d);
  return scene;
}

// Returns noise on disparities that form stairs or a pyramid. Each step ends every run of equal
// shifts but is not a depth edge, so the runs are the same wherever a line begins.
test::Scene StairScene(int width, int height, int views, float limit, test::Random* random) {
  constexpr float kStep = 1.25f;
  test::Scene scene = NoiseScene(width, height, views, limit, random);
  const int tread = random->Int(8, 40), kind = random->Int(0, 2);
  const int cx = random->Int(0, width - 1), cy = random->Int(0, height - 1);
  const int steps = static_cast<int>(limit / kStep), first = random->Int(-steps, steps);
  const int direction = random->Int(0, 1) * 2 - 1;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int dx = std::abs(x - cx), dy = std::abs(y - cy);
      const int along = kind == 0 ? dx : kind == 1 ? dy : std::max(dx, dy);
      const int step = std::clamp(first + direction * (along / tread), -steps, steps);
      scene.Disparity(x, y) = kStep * static_cast<float>(step);
    }
  }
  return scene;
}

// Returns noise on rectangles whose disparities differ so much that every edge ends a run.
test::Scene SteppedScene(int width, int height, int views, float limit, test::Random* random) {
  test::Scene scene = NoiseScene(width, height, views, limit, random);
  const int steps = static_cast<int>(limit) / 2;
  const int pieces = random->Int(2, 12);
  for (int piece = 0; piece < pieces; ++piece) {
    const float d = static_cast<float>(2 * random->Int(-steps, steps));
    const int x0 = piece == 0 ? 0 : random->Int(0, width - 1);
    const int y0 = piece == 0 ? 0 : random->Int(0, height - 1);
    const int x1 = piece == 0 ? width : std::min(width, x0 + random->Int(1, width));
    const int y1 = piece == 0 ? height : std::min(height, y0 + random->Int(1, height));
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) scene.Disparity(x, y) = d;
    }
  }
  return scene;
}

// Numbers of blocks and samples that change with a wider border, for each layer.
struct FrameDiff {
  int blocks[STARFOCUS_LAYERS] = {}, changed[STARFOCUS_LAYERS] = {}, largest[STARFOCUS_LAYERS] = {};
  int64_t samples[STARFOCUS_LAYERS] = {}, changed_samples[STARFOCUS_LAYERS] = {};

  void Add(const Block& block, const std::vector<uint8_t>& given,
           const std::vector<uint8_t>& wider) {
    const int layer = block.layer;
    blocks[layer] += 1;
    samples[layer] += 3 * block.rect.width * block.rect.height;
    changed[layer] += given != wider;
    for (size_t i = 0; i < given.size(); ++i) {
      const int difference = std::abs(given[i] - wider[i]);
      changed_samples[layer] += difference != 0;
      largest[layer] = std::max(largest[layer], difference);
    }
  }
  void Tell() const {
    for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
      char text[160];
      std::snprintf(text, sizeof(text),
                    "layer %d: %d of %d blocks change, %lld of %lld samples, by at most %d", layer,
                    changed[layer], blocks[layer], static_cast<long long>(changed_samples[layer]),
                    static_cast<long long>(samples[layer]), largest[layer]);
      MESSAGE(std::string(text));
    }
  }
};

void CheckPicture(const test::Scene& scene, const starfocus::Params& params, int more,
                  FrameDiff* changes) {
  test::Config config = test::ConfigFor(scene, 40);
  config.tuning.gather = 0;  // All cells are rendered from views.
  config.superblock = 128;   // One superblock, so that layers are complete.
  config.tuning.n_scale = more % 2 == 0 ? 1 : STARFOCUS_MIN_N_SCALE;
  test::Engine engine(config);
  const test::Output out = test::OutputOf(&engine, params, scene);
  for (Block block : test::PlanOf(engine.get()).blocks) {
    // The blocks are rendered again, because `out` has been deblocked.
    const std::vector<uint8_t> given = test::RenderOne(block, engine.get());
    block.border.left += more;
    block.border.right += more;
    block.border.top += more;
    block.border.bottom += more;
    changes->Add(block, given, test::RenderOne(block, engine.get()));
  }
}

template <class MakeScene>
FrameDiff CheckPictures(int rounds, double least_aperture, const MakeScene& make_scene) {
  test::Random random(21);
  FrameDiff changes;
  constexpr double kFocus[] = {0, 0.3, -1.45, 2.5, 7.2, 11, -13.6, 16};
  for (int round = 0; round < rounds; ++round) {
    const int width = random.Int(0, 9) == 0 ? random.Int(1, 20) : random.Int(17, 128);
    const int height = random.Int(0, 9) == 0 ? random.Int(1, 20) : random.Int(17, 128);
    const float limit = static_cast<float>(2 * random.Int(1, 6));
    const test::Scene scene =
        make_scene(width, height, test::kStars[random.Int(0, 3)], limit, &random);
    const double aperture = random.Int(0, 1) == 0 ? 1 : random.Real(least_aperture, 1);
    starfocus::Params params =
        test::Params(kFocus[random.Int(0, 7)], aperture, STARFOCUS_MODE_BLOCK);
    params.study.renderer =
        round % 2 == 0 ? STARFOCUS_RENDERER_LINE_SCAN : STARFOCUS_RENDERER_SLICES;
    CheckPicture(scene, params, random.Int(1, 9), &changes);
  }
  changes.Tell();
  return changes;
}

void CheckSmall(const FrameDiff& changes) {
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    CHECK(changes.blocks[layer] > 50);
    CHECK(changes.changed_samples[layer] * 1000 <= changes.samples[layer]);
    CHECK(changes.largest[layer] <= 9);  // the light of one of 29 views: 255 / 29
  }
}

TEST_CASE(
    "refocus_block: for a flat surface, the border suffices at every layer, size and position") {
  const FrameDiff changes = CheckPictures(200, 0.3, FlatScene);
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    CHECK(changes.blocks[layer] > 30);
    CHECK(changes.changed[layer] == 0);
  }
}

TEST_CASE("refocus_block: for stretched surfaces, a wider border hardly changes a block") {
  CheckSmall(CheckPictures(250, 0.9, StairScene));
}

TEST_CASE("refocus_block: for surfaces with holes, a wider border hardly changes a block") {
  CheckSmall(CheckPictures(300, 0.3, SteppedScene));
}

}  // namespace
}  // namespace refocus_block_test
