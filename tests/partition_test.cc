// The quadtree against all partitions there are, with the rules for layers and views and the timing
// model applied anew.
#include "lib/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/engine.h"
#include "tests/test_scene.h"

namespace {

using starfocus::Block;
using starfocus::BlockStats;
using starfocus::BlurScale;
using starfocus::Border;
using starfocus::Cell;
using starfocus::CellGrid;
using starfocus::kCellSize;
using starfocus::kLayerMargin;
using starfocus::kSmallestBlock;
using starfocus::PartitionNode;
using starfocus::PartitionRules;
using starfocus::Rect;
using starfocus::ViewCounts;
using starfocus::Window;

constexpr int kMaxN = 110;
constexpr double kRadiusOne = 1 << starfocus::kDisparityBits;

// A disparity map measured, and the rules of a partition.
struct Plan {
  Plan(int width, int height, int largest_block, double limit, test::Random* random)
      : disparity(size_t(width) * size_t(height)), views(kMaxN + 1) {
    const int pieces = random->Int(0, 8);
    for (int piece = 0; piece <= pieces; ++piece) {
      const int x0 = piece == 0 ? 0 : random->Int(0, width - 1);
      const int y0 = piece == 0 ? 0 : random->Int(0, height - 1);
      const int x1 = piece == 0 ? width : std::min(width, x0 + random->Int(1, width));
      const int y1 = piece == 0 ? height : std::min(height, y0 + random->Int(1, height));
      const double d = random->Real(-limit, limit);
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          disparity[size_t(y) * size_t(width) + size_t(x)] = int16_t(d * kRadiusOne);
        }
      }
    }
    Window window;
    window.width = window.picture_width = width;
    window.height = window.picture_height = height;
    window.disparity = {disparity.data(), size_t(width), 0, 0};
    const double focus = random->Real(-limit, limit);
    const BlurScale scale = {int32_t(focus * kRadiusOne), int64_t{1} << starfocus::kStepBits};
    rules.scale = scale;
    grid.columns = (width + kCellSize - 1) / kCellSize;
    grid.rows = grid.last_row = (height + kCellSize - 1) / kCellSize;
    cells.resize(size_t(grid.columns) * size_t(grid.rows));
    grid.cells = cells.data();
    for (int row = 0; row < grid.rows; ++row) {
      for (int column = 0; column < grid.columns; ++column) {
        *grid.At(column, row) =
            starfocus::MeasureCell(starfocus::simd::BestKernels(), window, scale, column, row);
      }
    }
    around = starfocus::GetReach(2 * limit).cells;
    flags.assign(cells.size(), test::kPoison);
    gathered = {flags.data(), grid.columns, 0};
    for (int n = 0; n <= kMaxN; ++n) views[size_t(n)] = starfocus::CountViews(n);
    rules.width = width;
    rules.height = height;
    rules.largest_block = largest_block;
    rules.max_layer = random->Int(0, 2);
    rules.max_n = kMaxN;
    rules.cells = random->Int(0, 1) == 1;
    rules.gathers = rules.cells;
    rules.n_scale = (2 + 2 * rules.max_layer + rules.cells) / 4.0;
    rules.timing = starfocus::DefaultTiming();
    rules.views = views.data();
  }
  Plan(const Plan&) = delete;

  std::vector<Block> Partition(int x, int y) const {
    std::vector<PartitionNode> nodes(size_t(starfocus::PartitionNodes(rules.largest_block)));
    std::memset(static_cast<void*>(nodes.data()), test::kPoison,
                nodes.size() * sizeof(PartitionNode));
    std::vector<Block> blocks(size_t(starfocus::MaxBlocks(rules.largest_block)));
    const int count =
        starfocus::PartitionBlock(rules, grid, x, y, around, nodes.data(), blocks.data(), gathered);
    REQUIRE(count >= 1);
    REQUIRE(count <= int(blocks.size()));
    blocks.resize(size_t(count));
    return blocks;
  }

  // Whether the cell at pixel (x, y) is one that need not be refocused by views.
  bool MayGather(int x, int y) const {
    const int column = x / kCellSize, row = y / kCellSize;
    const uint32_t smooth = starfocus::FindSmooth(grid, rules.scale, column & ~1, row & ~1, around);
    const bool is_smooth = (smooth >> (column % 2 + 2 * (row % 2)) & 1) != 0;
    return rules.gathers && is_smooth && grid.At(column, row)->r_max <= 12 * int(kRadiusOne);
  }

  bool Inside(int x, int y) const { return x < rules.width && y < rules.height; }

  // The statistics of any block, from its blocks of 16.
  BlockStats Stats(int x, int y, int side) const {
    if (side == kSmallestBlock) {
      return starfocus::MeasureBlock(grid, x / kCellSize, y / kCellSize, around);
    }
    BlockStats stats[4];
    const BlockStats* children[4];
    for (int child = 0; child < 4; ++child) {
      const int cx = x + child % 2 * side / 2, cy = y + child / 2 * side / 2;
      children[child] = nullptr;
      if (!Inside(cx, cy)) continue;
      stats[child] = Stats(cx, cy, side / 2);
      children[child] = &stats[child];
    }
    return starfocus::MergeBlocks(children, side / 2);
  }

  std::vector<int16_t> disparity;
  std::vector<Cell> cells;
  std::vector<uint8_t> flags;  // of gathered
  starfocus::GatherMap gathered;
  std::vector<ViewCounts> views;
  CellGrid grid;
  int around = 0;
  PartitionRules rules;
};

// Layers from `radius` and twice that on.
int LayerFrom(double r_min, double radius) {
  return r_min >= 2 * radius ? 2 : r_min >= radius ? 1 : 0;
}

// (12), or with wide aperture cells only where less can go wrong: layer 2 later, layer 1 later
// beside silhouettes, which are never rounded to four pixels.
int LayerOf(bool cells, double r_min, bool silhouette) {
  if (!cells) return LayerFrom(r_min, 3);
  if (silhouette) return r_min < 4 ? 0 : 1;
  return r_min < 3 ? 0 : r_min < 8 ? 1 : 2;
}

// (9), or what wide aperture cells need.
int ViewsOf(bool cells, double r_max) {
  if (cells) {
    constexpr struct {
      double r_max;
      int n;
    } kSteps[] = {{0.5, 0}, {11, 4}, {24, 6}, {32, 8}, {45, 10}};
    for (const auto& step : kSteps) {
      if (r_max <= step.r_max) return step.n;
    }
    REQUIRE(false);
  }
  if (r_max < 4) return int(std::ceil(r_max));
  if (r_max < 4 / 0.787) return 4;
  return int(std::ceil(0.787 * r_max));
}

int CeilQuotient(int value, int by) { return (value + by - 1) / by; }

// Leaves to views what holds the cells that may not be gathered: their rectangle, and N and border
// of the units of 16 that they lie in.
void PlanRest(const Plan& plan, Block* block) {
  const Rect rect = block->rect;
  int left = INT32_MAX, top = INT32_MAX, right = 0, bottom = 0, r_max = 0;
  const auto for_each = [&](const auto& visit) {
    for (int y = rect.y; y < rect.y + rect.height; y += kCellSize) {
      for (int x = rect.x; x < rect.x + rect.width; x += kCellSize) {
        if (!plan.MayGather(x, y)) visit(x, y);
      }
    }
  };
  for_each([&](int x, int y) {
    left = std::min(left, x);
    top = std::min(top, y);
    right = std::max(right, std::min(x + kCellSize, plan.rules.width));
    bottom = std::max(bottom, std::min(y + kCellSize, plan.rules.height));
  });
  block->n = 0;
  block->rendered = {};
  block->border = {};
  if (right == 0) return;
  block->rendered = {left, top, right - left, bottom - top};
  Border border = {0, 0, 0, 0};
  for_each([&](int x, int y) {
    const int unit_x = x / kSmallestBlock * kSmallestBlock;
    const int unit_y = y / kSmallestBlock * kSmallestBlock;
    const BlockStats stats = plan.Stats(unit_x, unit_y, kSmallestBlock);
    const Border& part = stats.border[0];
    r_max = std::max(r_max, stats.r_max);
    border.left = std::max(border.left, left - (unit_x - part.left));
    border.top = std::max(border.top, top - (unit_y - part.top));
    border.right = std::max(border.right, unit_x + kSmallestBlock + part.right - right);
    border.bottom = std::max(border.bottom, unit_y + kSmallestBlock + part.bottom - bottom);
  });
  block->n = std::min(int(std::ceil(ViewsOf(true, r_max / kRadiusOne) * plan.rules.n_scale)),
                      plan.rules.max_n);
  block->border = {border.left + 1, border.right + 1, border.top + 1, border.bottom + 1};
}

// Gathers what may be: at layer 0, and where that is the whole block.
void PlanGathering(const Plan& plan, Block* block) {
  uint64_t cells = 0, others = 0, gather = 0;
  for (int y = block->rect.y; y < block->rect.y + block->rect.height; y += kCellSize) {
    for (int x = block->rect.x; x < block->rect.x + block->rect.width; x += kCellSize) {
      ++cells;
      if (plan.MayGather(x, y)) {
        gather += starfocus::PredictGather(plan.rules.timing, kCellSize * kCellSize,
                                           plan.grid.At(x / kCellSize, y / kCellSize)->r_max);
      } else {
        ++others;
      }
    }
  }
  if (others == cells || (others > 0 && block->layer > 0)) return;
  block->layer = 0;
  block->gathers = true;
  block->cost = gather + block->cost * others / cells;
  PlanRest(plan, block);
}

// A block with the parameters that the rules give it.
Block Planned(const Plan& plan, int x, int y, int side) {
  const BlockStats stats = plan.Stats(x, y, side);
  Block block = {};
  block.rect = {x, y, std::min(side, plan.rules.width - x), std::min(side, plan.rules.height - y)};
  const bool cells = plan.rules.cells;
  block.layer =
      std::min(LayerOf(cells, stats.r_min / kRadiusOne, stats.r_edge > 0), plan.rules.max_layer);
  const int scale = 1 << block.layer;
  const int views = ViewsOf(cells, stats.r_max / (kRadiusOne * scale));
  block.n = std::min(int(std::ceil(views * plan.rules.n_scale)), plan.rules.max_n);
  const int margin = kLayerMargin[block.layer] / scale;
  block.rendered = {x / scale - margin, y / scale - margin,
                    CeilQuotient(block.rect.width, scale) + 2 * margin,
                    CeilQuotient(block.rect.height, scale) + 2 * margin};
  const Border& border = stats.border[block.layer];
  const auto beyond = [&](int pixels) {
    return std::max(0, CeilQuotient(pixels, scale) - margin) + 1;
  };
  block.border = {beyond(border.left), beyond(border.right + side - block.rect.width),
                  beyond(border.top), beyond(border.bottom + side - block.rect.height)};
  const uint64_t upsampled =
      block.layer == 0 ? 0 : uint64_t(block.rect.width) * uint64_t(block.rect.height);
  block.cost = starfocus::PredictTime(
      plan.rules.timing,
      starfocus::MeasureWork(block.rendered, block.border, starfocus::CountViews(block.n),
                             plan.rules.cells, upsampled, stats.content, block.layer));
  if (block.n > 0) PlanGathering(plan, &block);
  return block;
}

// The cost of every partition of a block, by brute force.
std::vector<uint64_t> AllCosts(const Plan& plan, int x, int y, int side) {
  std::vector<uint64_t> costs = {Planned(plan, x, y, side).cost};
  if (side == kSmallestBlock) return costs;
  std::vector<uint64_t> sums = {0};
  for (int child = 0; child < 4; ++child) {
    const int cx = x + child % 2 * side / 2, cy = y + child / 2 * side / 2;
    if (!plan.Inside(cx, cy)) continue;
    std::vector<uint64_t> longer;
    for (const uint64_t cost : AllCosts(plan, cx, cy, side / 2)) {
      for (const uint64_t sum : sums) longer.push_back(sum + cost);
    }
    sums = longer;
  }
  costs.insert(costs.end(), sums.begin(), sums.end());
  return costs;
}

// The least cost, where all partitions are too many to list.
uint64_t LeastCost(const Plan& plan, int x, int y, int side) {
  if (side <= 64) {
    const std::vector<uint64_t> all = AllCosts(plan, x, y, side);
    return *std::min_element(all.begin(), all.end());
  }
  uint64_t split = 0;
  for (int child = 0; child < 4; ++child) {
    const int cx = x + child % 2 * side / 2, cy = y + child / 2 * side / 2;
    if (plan.Inside(cx, cy)) split += LeastCost(plan, cx, cy, side / 2);
  }
  return std::min(split, Planned(plan, x, y, side).cost);
}

bool Same(const Rect& a, const Rect& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}
bool Same(const Border& a, const Border& b) {
  return a.left == b.left && a.right == b.right && a.top == b.top && a.bottom == b.bottom;
}

// Side of the quadtree's node that a block is: of the least that hold it.
int SideOf(const Plan& plan, const Block& block, int x, int y) {
  int side = kSmallestBlock;
  while (side < block.rect.width || side < block.rect.height) side *= 2;
  // At the picture's edge a clipped block may be that of a larger node.
  for (; side <= plan.rules.largest_block; side *= 2) {
    if ((block.rect.x - x) % side == 0 && (block.rect.y - y) % side == 0 &&
        Planned(plan, block.rect.x, block.rect.y, side).cost == block.cost) {
      return side;
    }
  }
  return 0;
}

void CheckBlocks(const Plan& plan, int x, int y, const std::vector<Block>& blocks) {
  const int side = plan.rules.largest_block;
  std::vector<int> covered(size_t(side) * size_t(side));
  for (const Block& block : blocks) {
    const Rect& rect = block.rect;
    REQUIRE(rect.width > 0);
    REQUIRE(rect.height > 0);
    REQUIRE(rect.x + rect.width <= std::min(x + side, plan.rules.width));
    REQUIRE(rect.y + rect.height <= std::min(y + side, plan.rules.height));
    for (int row = rect.y; row < rect.y + rect.height; ++row) {
      for (int column = rect.x; column < rect.x + rect.width; ++column) {
        covered[size_t(row - y) * size_t(side) + size_t(column - x)] += 1;
      }
    }
    const int node = SideOf(plan, block, x, y);
    CAPTURE(rect.x);
    CAPTURE(rect.y);
    CAPTURE(rect.width);
    CAPTURE(rect.height);
    REQUIRE(node > 0);
    const Block planned = Planned(plan, rect.x, rect.y, node);
    CHECK(Same(rect, planned.rect));
    CHECK(Same(block.rendered, planned.rendered));
    CHECK(Same(block.border, planned.border));
    CHECK(block.layer == planned.layer);
    CHECK(block.n == planned.n);
    CHECK(block.gathers == planned.gathers);
    for (int row = rect.y; row < rect.y + rect.height && block.gathers; row += kCellSize) {
      for (int column = rect.x; column < rect.x + rect.width; column += kCellSize) {
        CHECK((plan.gathered.At(column, row) != 0) == plan.MayGather(column, row));
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

// Checks every largest block of a picture; the number of blocks.
size_t CheckPicture(const Plan& plan) {
  size_t count = 0;
  const int side = plan.rules.largest_block;
  for (int y = 0; y < plan.rules.height; y += side) {
    for (int x = 0; x < plan.rules.width; x += side) {
      CAPTURE(plan.rules.width);
      CAPTURE(plan.rules.height);
      CAPTURE(side);
      CAPTURE(x);
      CAPTURE(y);
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

TEST_CASE("partition: the least of all partitions, tiled once, by the rules") {
  test::Random random(7);
  size_t blocks = 0, largest_blocks = 0;
  for (int round = 0; round < 60; ++round) {
    const int side = 32 << random.Int(0, 3);
    const int width = random.Int(1, side + 40), height = random.Int(1, side + 40);
    Plan plan(width, height, side, random.Real(0.5, 14), &random);
    if (round % 2 == 1) plan.rules.timing.block = 0;  // whatever a block costs here, splits more
    blocks += CheckPicture(plan);
    largest_blocks += size_t(((width - 1) / side + 1) * ((height - 1) / side + 1));
  }
  CHECK(blocks > 2 * largest_blocks);  // there was something to decide
}

TEST_CASE("partition: literally every partition of 128") {
  test::Random random(8);
  for (int round = 0; round < 3; ++round) {
    const Plan plan(128 - 30 * round, 128, 128, 8, &random);
    const std::vector<uint64_t> all = AllCosts(plan, 0, 0, 128);
    if (round == 0) CHECK(all.size() == 83522);  // 1 + (1 + 2^4)^4
    CHECK(Sum(plan.Partition(0, 0)) == *std::min_element(all.begin(), all.end()));
  }
}

TEST_CASE("partition: random and degenerate coefficients") {
  test::Random random(9);
  for (int round = 0; round < 60; ++round) {
    const int side = 32 << random.Int(0, 1);
    Plan plan(random.Int(1, side), random.Int(1, side), side, 9, &random);
    sf_timing& timing = plan.rules.timing;
    for (uint32_t* value : {&timing.block, &timing.field, &timing.a, &timing.b, &timing.c,
                            &timing.upsample, &timing.span, &timing.hole}) {
      const int kind = random.Int(0, 3);
      *value = kind == 0 ? 0 : kind == 1 ? SF_MAX_TIMING : uint32_t(random.Int(0, SF_MAX_TIMING));
    }
    CheckPicture(plan);
  }
}

TEST_CASE("partition: where nothing or only blocks cost, nothing is split") {
  test::Random random(10);
  for (const uint32_t block : {0u, 1u, SF_MAX_TIMING}) {
    for (const int side : {32, 64, 128, 256}) {
      Plan plan(side - 5, side, side, 10, &random);
      plan.rules.timing = {};
      plan.rules.gathers = false;  // what is gathered is not the block's
      plan.rules.timing.block = block;
      const std::vector<Block> blocks = plan.Partition(0, 0);
      REQUIRE(blocks.size() == 1);
      CHECK(blocks[0].rect.width == side - 5);
      CHECK(blocks[0].rect.height == side);
      CHECK(blocks[0].cost == block);
    }
  }
}

TEST_CASE("partition: the rules on flat pictures, at and beside their thresholds") {
  const int kMiddle = 128;
  for (const double r :
       {0.0,   1 / 64.0, 0.5,       1.0,     2.0,      2.984375, 3.0,      3.015625,  3.5, 3.984375,
        4.0,   5.0,      5.078125,  5.09375, 5.984375, 6.0,      6.015625, 7.984375,  8.0, 8.015625,
        10.25, 11.0,     11.015625, 15.9,    16.0,     20.5,     24.0,     24.015625, 30.0}) {
    for (int max_layer = 0; max_layer <= 2; ++max_layer) {
      test::Random random(1);
      Plan plan(3 * kMiddle, 3 * kMiddle, 128, 1, &random);
      Window window;
      window.width = window.picture_width = window.height = window.picture_height = 3 * kMiddle;
      std::fill(plan.disparity.begin(), plan.disparity.end(), int16_t(std::floor(r * 64)));
      window.disparity = {plan.disparity.data(), size_t(3 * kMiddle), 0, 0};
      const BlurScale scale = {0, int64_t{1} << starfocus::kStepBits};
      plan.rules.scale = scale;
      for (int row = 0; row < plan.grid.rows; ++row) {
        for (int column = 0; column < plan.grid.columns; ++column) {
          *plan.grid.At(column, row) =
              starfocus::MeasureCell(starfocus::simd::BestKernels(), window, scale, column, row);
        }
      }
      plan.around = starfocus::GetReach(r).cells;
      plan.rules.max_layer = max_layer;
      plan.rules.n_scale = 1;
      const double exact = std::floor(r * 64) / 64;
      CAPTURE(exact);
      CAPTURE(max_layer);
      for (const bool cells : {false, true}) {
        CAPTURE(cells);
        plan.rules.cells = plan.rules.gathers = cells;
        for (const Block& block : plan.Partition(kMiddle, kMiddle)) {
          const bool gathered = cells && exact > 0.5 && exact <= 12;
          CHECK(block.gathers == gathered);
          if (gathered) {
            CHECK(block.layer == 0);
            CHECK(block.n == 0);
            CHECK(block.rendered.width == 0);
            continue;
          }
          const int layer = std::min(LayerOf(cells, exact, false), max_layer);
          CHECK(block.layer == layer);
          CHECK(block.n == ViewsOf(cells, exact / (1 << layer)));
        }
      }
    }
  }
}

TEST_CASE("partition: a picture in focus stays whole") {
  test::Random random(11);
  Plan flat(256, 256, 128, 0.001, &random);
  CHECK(flat.Partition(128, 0).size() == 1);
  CHECK(flat.Partition(0, 128).size() == 1);
}

TEST_CASE("partition: N never exceeds its table") {
  test::Random random(12);
  for (int round = 0; round < 20; ++round) {
    Plan plan(90, 70, 64, 20, &random);
    plan.rules.max_n = random.Int(0, 12);
    plan.rules.max_layer = 0;
    for (const Block& block : plan.Partition(0, 0)) CHECK(block.n <= plan.rules.max_n);
  }
}

}  // namespace
