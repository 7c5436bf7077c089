// SPDX-License-Identifier: Apache-2.0
// Compares the quadtree with all possible partitions. The tests apply the rules for layers and
// views and the timing model independently of the engine.
#include "lib/plan/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "starfocus/experimental.h"
#include "tests/lib/measured_cells.h"
#include "tests/support/inside.h"
#include "tests/support/partition_plan.h"
#include "tests/support/test_scene.h"

namespace partition_test {
namespace {

using namespace starfocus;
using namespace test;

bool Same(const Rect& a, const Rect& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}
bool Same(const Border& a, const Border& b) {
  return a.left == b.left && a.right == b.right && a.top == b.top && a.bottom == b.bottom;
}

// Returns the side of the smallest square of the quadtree that contains the block and has the same
// cost and border, or 0 if there is none.
int SideOf(const Plan& plan, const Block& block, int x, int y) {
  int side = kSmallestBlock;
  while (side < block.rect.width || side < block.rect.height) side *= 2;
  // At the edge of the picture, a clipped block may belong to a larger square.
  for (; side <= plan.config.superblock; side *= 2) {
    if ((block.rect.x - x) % side != 0 || (block.rect.y - y) % side != 0) continue;
    const Block planned = Planned(plan, block.rect.x, block.rect.y, side);
    if (planned.cost == block.cost && Same(planned.border, block.border)) return side;
  }
  return 0;
}

void CheckBlocks(const Plan& plan, int x, int y, const std::vector<Block>& blocks) {
  const int side = plan.config.superblock;
  std::vector<int> covered(size_t(side) * size_t(side));
  for (const Block& block : blocks) {
    const Rect& rect = block.rect;
    REQUIRE(rect.width > 0);
    REQUIRE(rect.height > 0);
    REQUIRE(rect.x + rect.width <= std::min(x + side, plan.config.width));
    REQUIRE(rect.y + rect.height <= std::min(y + side, plan.config.height));
    for (int row = rect.y; row < rect.y + rect.height; ++row) {
      for (int column = rect.x; column < rect.x + rect.width; ++column) {
        covered[size_t(row - y) * size_t(side) + size_t(column - x)] += 1;
      }
    }
    const int candidate = SideOf(plan, block, x, y);
    CAPTURES(rect.x, rect.y, rect.width, rect.height);
    REQUIRE(candidate > 0);
    const Block planned = Planned(plan, rect.x, rect.y, candidate);
    CHECK(Same(rect, planned.rect));
    CHECK(Same(block.rendered, planned.rendered));
    CHECK(block.layer == planned.layer);
    CHECK(block.n == planned.n);
    CHECK(block.gathers == planned.gathers);
    for (int row = rect.y; row < rect.y + rect.height && block.gathers; row += kCellSize) {
      for (int column = rect.x; column < rect.x + rect.width; column += kCellSize) {
        const bool gathered = plan.gathered.FirstLayer(column, row) <= block.layer;
        CHECK(gathered == plan.MayGather(column, row, block.layer));
      }
    }
  }
  bool once = true;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const bool inside = plan.Inside(x + column, y + row);
      once = once && covered[size_t(row) * size_t(side) + size_t(column)] == (inside ? 1 : 0);
    }
  }
  CHECK(once);
}

uint64_t Sum(const std::vector<Block>& blocks) {
  uint64_t sum = 0;
  for (const Block& block : blocks) sum += block.cost;
  return sum;
}

// Checks every superblock of a picture and returns the number of blocks.
size_t CheckPicture(const Plan& plan) {
  size_t count = 0;
  const int side = plan.config.superblock;
  for (int y = 0; y < plan.config.height; y += side) {
    for (int x = 0; x < plan.config.width; x += side) {
      CAPTURES(plan.config.width, plan.config.height, side, x, y);
      const std::vector<Block> blocks = plan.Partition(x, y);
      CHECK(Sum(blocks) == LeastCost(plan, x, y, side));
      CheckBlocks(plan, x, y, blocks);
      const std::vector<Block> again = plan.Partition(x, y);
      REQUIRE(again.size() == blocks.size());
      for (size_t k = 0; k < blocks.size(); ++k) CHECK(Same(again[k].rect, blocks[k].rect));
      count += blocks.size();
    }
  }
  return count;
}

// Sets random, smallest and largest coefficients.
void RandomTiming(starfocus_timing* timing, test::Random* random) {
  for (uint32_t* value : {&timing->block, &timing->field, &timing->a, &timing->b, &timing->c,
                          &timing->upsample, &timing->span, &timing->hole}) {
    const int kind = random->Int(0, 3);
    *value = kind == 0   ? 0
             : kind == 1 ? STARFOCUS_MAX_TIMING
                         : uint32_t(random->Int(0, STARFOCUS_MAX_TIMING));
  }
}

TEST_CASE(
    "partition: the cheapest partition is chosen, covers each pixel once and follows the rules") {
  test::Random random(7);
  size_t blocks = 0, superblocks = 0;
  for (int round = 0; round < 100; ++round) {
    const int side = 32 << random.Int(0, 3);
    const int width = random.Int(1, side + 40), height = random.Int(1, side + 40);
    Plan plan(width, height, side, random.Real(0.5, 14), &random);
    if (round % 2 == 1)
      plan.config.tuning.timing.block = 0;  // blocks without a fixed cost are split more often
    if (round % 4 == 2) RandomTiming(&plan.config.tuning.timing, &random);
    blocks += CheckPicture(plan);
    superblocks += size_t(((width - 1) / side + 1) * ((height - 1) / side + 1));
  }
  CHECK(blocks > 2 * superblocks);  // on average, a superblock has more than two blocks
}

TEST_CASE(
    "partition: superblocks are not split if nothing has a cost, or if only blocks have a cost") {
  test::Random random(10);
  for (const uint32_t block : {0u, 1u, STARFOCUS_MAX_TIMING}) {
    for (const int side : {32, 64, 128, 256}) {
      Plan plan(side - 5, side, side, 10, &random);
      plan.config.tuning.timing = {};
      // Cells that are blurred without views have other costs than timing.block.
      plan.rules.gathers = false;
      plan.config.tuning.timing.block = block;
      const std::vector<Block> blocks = plan.Partition(0, 0);
      REQUIRE(blocks.size() == 1);
      CHECK(blocks[0].rect.width == side - 5);
      CHECK(blocks[0].rect.height == side);
      CHECK(blocks[0].cost == block);
    }
  }
}

TEST_CASE(
    "partition: flat pictures follow the rules at the thresholds and close to the thresholds") {
  const int kMiddle = 128;
  for (const double r :
       {0.0,       1 / 64.0,  0.5,      1.0,       2.0,       2.984375, 3.0,       3.015625,
        3.5,       3.984375,  4.0,      4.984375,  5.0,       5.078125, 5.09375,   5.984375,
        6.0,       6.015625,  6.984375, 7.0,       7.984375,  8.0,      8.015625,  9.984375,
        10.0,      10.25,     11.0,     11.015625, 11.984375, 12.0,     13.984375, 14.0,
        15.9,      15.984375, 16.0,     20.5,      23.984375, 24.0,     24.015625, 30.0,
        41.140625, 41.15625,  48.0,     48.015625}) {
    for (int max_layer_and_demand = 0; max_layer_and_demand < 12; ++max_layer_and_demand) {
      const int max_layer = max_layer_and_demand / 4;
      test::Random random(1);
      Plan plan(3 * kMiddle, 3 * kMiddle, 128, 1, &random);
      std::fill(plan.disparity.begin(), plan.disparity.end(), int16_t(std::floor(r * 64)));
      const BlurScale scale = {{}, int64_t{1} << starfocus::kStepBits};
      plan.rules.scale = scale;
      plan.grid = test::MeasureCells(plan.disparity, 3 * kMiddle, 3 * kMiddle, scale, &plan.cells);
      plan.rules.around = test::BordersOf(r).cells;
      plan.rules.max_layer = max_layer;
      plan.config.tuning.n_scale = 1;
      plan.rules.demand = static_cast<starfocus::Demand>(max_layer_and_demand % 4);
      const double exact = std::floor(r * 64) / 64;
      CAPTURES(exact, max_layer_and_demand);
      for (const bool subapertures : {false, true}) {
        CAPTURE(subapertures);
        plan.Use(subapertures ? starfocus::kSliceRenderer
                              : starfocus_line_scan_renderer()->renderer);
        for (const Block& block : plan.Partition(kMiddle, kMiddle)) {
          const int layer =
              std::min(LayerOf(subapertures, exact, false, plan.rules.demand), max_layer);
          const bool gathered = subapertures && exact >= 1.0 / 16 && exact <= 12 << layer;
          CHECK(block.gathers == gathered);
          if (gathered) {
            CHECK(block.layer == (exact <= 12 ? 0 : layer));
            CHECK(block.n == 0);
            CHECK(block.rendered.width == 0);
            continue;
          }
          CHECK(block.layer == layer);
          CHECK(block.n == ViewsOf(subapertures, exact / (1 << layer), plan.rules.demand));
        }
      }
    }
  }
}

// Updates, for each layer, the largest number of rows that blocks of the superblock at row y read
// beyond the superblock. Rows outside the picture do not count.
void AddRowsBeyond(const Plan& plan, int y, const std::vector<Block>& blocks, int (*most)[3]) {
  for (const Block& block : blocks) {
    if (block.rendered.width == 0) continue;
    const int end = std::min(plan.config.height, y + plan.config.superblock);
    const int above = (y >> block.layer) - (block.rendered.y - block.border.top);
    const int below = block.rendered.y + block.rendered.height + block.border.bottom -
                      ((end + (1 << block.layer) - 1) >> block.layer);
    if (y > 0) (*most)[block.layer] = std::max((*most)[block.layer], above);
    if (end < plan.config.height) (*most)[block.layer] = std::max((*most)[block.layer], below);
  }
}

TEST_CASE("partition: for constant blur, blocks read all rows of their stripe's borders") {
  int slack[3] = {100, 100, 100};
  for (int r = 1; r <= 40; ++r) {
    test::Random random(1);
    Plan plan(192, 192, 64, 1, &random);
    plan.rules.scale = {{}, int64_t{1} << starfocus::kStepBits};
    std::fill(plan.disparity.begin(), plan.disparity.end(), int16_t(64 * r));
    plan.grid = test::MeasureCells(plan.disparity, 192, 192, plan.rules.scale, &plan.cells);
    const starfocus::Borders borders = test::BordersOf(r);
    plan.rules.around = borders.cells;
    plan.Use(starfocus_line_scan_renderer()->renderer);
    int most[3] = {};
    for (int max_layer = 0; max_layer <= 2; ++max_layer) {
      plan.rules.max_layer = max_layer;
      AddRowsBeyond(plan, 64, plan.Partition(64, 64), &most);
    }
    for (int layer = 0; layer < 3; ++layer) {
      const int rows = borders.layer[layer];
      CAPTURES(r, layer);
      CHECK(most[layer] <= rows);
      slack[layer] = std::min(slack[layer], rows - most[layer]);
    }
  }
  for (const int rows : slack) CHECK(rows == 0);
}

TEST_CASE("partition: for random maps, blocks read no rows beyond their stripe's borders") {
  test::Random random(13);
  for (int round = 0; round < 60; ++round) {
    const double limit = random.Real(0.5, 30);
    Plan plan(150, 200, 64, limit, &random);
    const starfocus::Borders borders = test::BordersOf(2 * limit);
    for (const int y : {0, 64, 128, 192}) {
      int most[3] = {};
      AddRowsBeyond(plan, y, plan.Partition(64, y), &most);
      CAPTURE(round);
      for (int layer = 0; layer < 3; ++layer) CHECK(most[layer] <= borders.layer[layer]);
    }
  }
}

TEST_CASE("partition: no block is larger than the largest allowed side") {
  test::Random random(12);
  Plan flat(256, 256, 128, 0.001, &random);
  for (const int side : {16, 32, 64}) {
    flat.rules.largest_side = side;
    const std::vector<Block> blocks = flat.Partition(128, 0);
    CHECK(blocks.size() == size_t(128 / side) * size_t(128 / side));
    for (const Block& block : blocks) CHECK(block.rect.width == side);
  }
}

TEST_CASE("partition: N never exceeds the largest N in the tables") {
  test::Random random(12);
  for (int round = 0; round < 20; ++round) {
    Plan plan(90, 70, 64, 20, &random);
    plan.rules.max_n = random.Int(0, 12);
    plan.rules.max_layer = 0;
    for (const Block& block : plan.Partition(0, 0)) CHECK(block.n <= plan.rules.max_n);
  }
}

}  // namespace
}  // namespace partition_test
