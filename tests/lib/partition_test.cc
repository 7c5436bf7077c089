// SPDX-License-Identifier: Apache-2.0
// Compares the quadtree with all possible partitions. The tests apply the rules for layers and
// views and the timing model independently of the engine.
#include "lib/plan/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "lib/optics/psf.h"
#include "starfocus/experimental.h"
#include "tests/lib/measured_cells.h"
#include "tests/support/config.h"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

// Plans the partition of a random disparity map independently of the engine. Computes the
// parameters of each block by the rules for layers, views and cells blurred without views, and by
// the timing model. For comparison, the code computes the costs of all possible partitions.
namespace test {

using starfocus::Block;
using starfocus::BlockStats;
using starfocus::BlurScale;
using starfocus::Border;
using starfocus::Cell;
using starfocus::CellGrid;
using starfocus::kCellSize;
using starfocus::kSliceRenderer;
using starfocus::kSmallestBlock;
using starfocus::kUpsampleBorder;
using starfocus::PartitionCandidate;
using starfocus::PartitionRules;
using starfocus::Rect;
using starfocus::Renderer;

constexpr double kRadiusOne = 1 << starfocus::kDisparityBits;

// Apertures of a renderer, for every N that is planned for blur radii up to 128 pixels.
struct Apertures {
  explicit Apertures(const Renderer& renderer) : all(&renderer == &kSliceRenderer ? 30 : 110) {
    for (size_t n = 0; n < all.size(); ++n) {
      std::vector<uint16_t> weights(starfocus::ViewWeightsSize(int(n)));
      all[n] = renderer.make_aperture(int(n), starfocus::ApertureFallOff(0.8), weights.data());
      all[n].weights = nullptr;  // Planning does not read the weights of views.
    }
  }
  std::vector<starfocus::ViewWeights> all;
};
inline const std::vector<starfocus::ViewWeights>& AperturesOf(const Renderer& renderer) {
  static const Apertures slices(kSliceRenderer),
      line_scan(starfocus_line_scan_renderer()->renderer);
  return (&renderer == &kSliceRenderer ? slices : line_scan).all;
}

// A random disparity map, the measured cells of the map, and the rules of a partition.
struct Plan {
  Plan(int width, int height, int superblock, double limit, Random* random)
      : disparity(size_t(width) * size_t(height)) {
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
    const double focus = random->Real(-limit, limit);
    const BlurScale scale = {starfocus::MakeFocusRange(focus), int64_t{1} << starfocus::kStepBits};
    rules.kernels = &starfocus::simd::BestKernels();
    rules.scale = scale;
    grid = MeasureCells(disparity, width, height, scale, &cells);
    rules.around = BordersOf(2 * limit).cells;
    flags.assign(cells.size(), kPoison);
    gathered = {flags.data(), grid.columns, 0};
    rules.config = &config;
    config.width = width;
    config.height = height;
    config.superblock = superblock;
    rules.max_layer = random->Int(0, 2);
    Use(random->Int(0, 1) == 1 ? kSliceRenderer : starfocus_line_scan_renderer()->renderer);
    rules.demand = static_cast<starfocus::Demand>((width + rules.max_layer) % 4);
    rules.largest_side = superblock;
    config.tuning.n_scale = (2 + 2 * rules.max_layer + IsSlices()) / 4.0;
  }
  Plan(const Plan&) = delete;

  bool IsSlices() const { return rules.renderer == &kSliceRenderer; }

  void Use(const Renderer& renderer) {
    rules.renderer = &renderer;
    rules.apertures = AperturesOf(renderer).data();
    rules.max_n = int(AperturesOf(renderer).size()) - 1;
    rules.gathers = renderer.gathers;
  }

  std::vector<Block> Partition(int x, int y) const {
    std::vector<PartitionCandidate> candidates(
        size_t(starfocus::PartitionCandidates(config.superblock)));
    std::memset(static_cast<void*>(candidates.data()), kPoison,
                candidates.size() * sizeof(PartitionCandidate));
    std::vector<Block> blocks(size_t(starfocus::MaxBlocks(config.superblock)));
    std::vector<int16_t> samples(
        starfocus::SurroundingSamples(config.superblock / kCellSize, rules.around), kPoison);
    const int count = starfocus::PartitionBlock(rules, grid, x, y, candidates.data(),
                                                samples.data(), gathered, blocks.data());
    REQUIRE(count >= 1);
    REQUIRE(count <= int(blocks.size()));
    blocks.resize(size_t(count));
    return blocks;
  }

  // Returns true if blocks of the layer may gather the cell at pixel (x, y) instead of rendering
  // views.
  bool MayGather(int x, int y, int layer) const {
    const int column = x / kCellSize, row = y / kCellSize;
    return rules.gathers &&
           test::KindOf(grid, rules.scale, column, row, rules.around) !=
               starfocus::CellKind::kMixed &&
           grid.At(column, row)->r_max <= (12 << layer) * int(kRadiusOne);
  }

  bool Inside(int x, int y) const { return x < config.width && y < config.height; }

  // Returns the statistics of a block of `side` pixels, merged from the statistics of blocks of 16
  // pixels.
  BlockStats Stats(int x, int y, int side) const {
    if (side == kSmallestBlock) {
      return test::MeasureBlock(grid, rules.scale, x / kCellSize, y / kCellSize, rules.around);
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
  std::vector<uint8_t> flags;  // For each cell, true if the cell is blurred without views.
  starfocus::GatherMap gathered;
  CellGrid grid;
  starfocus::FullConfig config = test::Config();
  PartitionRules rules = {};
};

// Returns the layer for a smallest blur radius of r_min, where layer 1 starts at `radius` and layer
// 2 at twice `radius`.
inline int LayerFrom(double r_min, double radius) {
  return r_min >= 2 * radius ? 2 : r_min >= radius ? 1 : 0;
}

// Returns the layer of a block by (12), or by the rule for subapertures. The rule for subapertures
// uses layers 1 and 2 only for larger radii, and never uses layer 2 for silhouettes. For openings
// with sharp edges, layers 1 and 2 start at even larger radii.
inline int LayerOf(bool subapertures, double r_min, bool silhouette, starfocus::Demand demand) {
  constexpr double kPaper[] = {3, 4, 5, 6}, kCells[] = {7, 12, 14, 16};
  const auto index = static_cast<size_t>(demand);
  if (!subapertures) return LayerFrom(r_min, kPaper[index]);
  const double first = kCells[index];
  return r_min < first ? 0 : r_min < 24 * first / 7 || silhouette ? 1 : 2;
}

// Returns N by equation (9), or by the rule for subapertures. By the rule for subapertures, N is
// larger for openings without fall-off.
inline int ViewsOf(bool subapertures, double r_max, starfocus::Demand demand) {
  if (subapertures && demand >= starfocus::Demand::kPolygon && r_max > 5 && r_max <= 34) return 6;
  if (subapertures && demand != starfocus::Demand::kFallOff && r_max > 0.5 && r_max <= 11) return 4;
  if (subapertures) {
    constexpr struct {
      double r_max;
      int n;
    } kSteps[] = {{0.5, 0}, {5.5, 3}, {11, 4}, {25, 5}, {34, 6}, {49, 7}};
    for (const auto& step : kSteps) {
      if (r_max <= step.r_max) return step.n;
    }
    REQUIRE(false);
  }
  if (r_max < 4) return int(std::ceil(r_max));
  if (r_max < 4 / 0.787) return 4;
  return int(std::ceil(0.787 * r_max));
}

inline int CeilQuotient(int value, int by) { return (value + by - 1) / by; }

// Plans the part of a block that views must render. The rendered part is the bounding rectangle of
// all cells that require views, in pixels of the layer. At the sides of the block, the rectangle
// includes the margin that upsampling reads. N and the border are computed from the blocks of 16
// pixels that contain cells to be rendered.
inline void PlanRest(const Plan& plan, Block* block) {
  const Rect rect = block->rect;
  const int scale = 1 << block->layer, margin = kUpsampleBorder[block->layer];
  const int end_x = rect.x + rect.width, end_y = rect.y + rect.height;
  int left = INT32_MAX, top = INT32_MAX, right = INT32_MIN, bottom = INT32_MIN, r_max = 0;
  const auto for_each = [&](const auto& visit) {
    for (int y = rect.y; y < end_y; y += kCellSize) {
      for (int x = rect.x; x < end_x; x += kCellSize) {
        if (!plan.MayGather(x, y, block->layer)) visit(x, y);
      }
    }
  };
  // Rounds the end of the block up to a whole pixel of the layer, in pixels of the picture.
  const auto up = [&](int pixels) { return CeilQuotient(pixels, scale) * scale; };
  for_each([&](int x, int y) {
    left = std::min(left, x - (x == rect.x ? margin : 0));
    top = std::min(top, y - (y == rect.y ? margin : 0));
    right = std::max(right, x + kCellSize < end_x ? x + kCellSize : up(end_x) + margin);
    bottom = std::max(bottom, y + kCellSize < end_y ? y + kCellSize : up(end_y) + margin);
  });
  block->n = 0;
  block->rendered = {};
  block->border = {};
  if (right < left) return;
  block->rendered = {left / scale, top / scale, (right - left) / scale, (bottom - top) / scale};
  if (left < 0) block->rendered.x = -CeilQuotient(-left, scale);
  if (top < 0) block->rendered.y = -CeilQuotient(-top, scale);
  Border border = {0, 0, 0, 0};
  for_each([&](int x, int y) {
    const int unit_x = x / kSmallestBlock * kSmallestBlock;
    const int unit_y = y / kSmallestBlock * kSmallestBlock;
    const BlockStats stats = plan.Stats(unit_x, unit_y, kSmallestBlock);
    const Border& part = stats.border[block->layer];
    r_max = std::max(r_max, stats.r_max);
    border.left = std::max(border.left, left - (unit_x - part.left));
    border.top = std::max(border.top, top - (unit_y - part.top));
    border.right = std::max(border.right, unit_x + kSmallestBlock + part.right - right);
    border.bottom = std::max(border.bottom, unit_y + kSmallestBlock + part.bottom - bottom);
  });
  const int views = ViewsOf(true, r_max / (kRadiusOne * scale), plan.rules.demand);
  block->n = std::min(int(std::ceil(views * plan.config.tuning.n_scale)), plan.rules.max_n);
  const auto beyond = [&](int pixels) { return CeilQuotient(pixels, scale) + 1; };
  block->border = {beyond(border.left), beyond(border.right), beyond(border.top),
                   beyond(border.bottom)};
}

// Predicted time of blurring cells of a block without views at a layer, and the number of these
// cells.
struct GatherPlan {
  uint64_t cells = 0, gathered = 0, cost = 0;

  GatherPlan(const Plan& plan, const Rect& rect, int layer) {
    const int side = kCellSize >> layer;
    for (int y = rect.y; y < rect.y + rect.height; y += kCellSize) {
      for (int x = rect.x; x < rect.x + rect.width; x += kCellSize) {
        ++cells;
        if (!plan.MayGather(x, y, layer)) continue;
        ++gathered;
        const int r_max = plan.grid.At(x / kCellSize, y / kCellSize)->r_max;
        cost += starfocus::PredictGather(plan.config.tuning.timing, uint64_t(side * side),
                                         r_max >> layer);
      }
    }
  }
};

// Plans to blur all suitable cells of a block by a filter, at the block's layer, instead of
// rendering views. If the whole block can be blurred by the filter at layer 0, the block is moved
// to layer 0. `upsampling` is the predicted time of upsampling, which is part of the block's cost.
inline void PlanGathering(const Plan& plan, uint64_t upsampling, Block* block) {
  const GatherPlan here(plan, block->rect, block->layer), below(plan, block->rect, 0);
  if (here.gathered > 0) {
    block->cost = here.cost + upsampling +
                  (block->cost - upsampling) * (here.cells - here.gathered) / here.cells;
    block->gathers = true;
  }
  if (block->layer > 0 && below.gathered == below.cells) {
    block->cost = below.cost;
    block->layer = 0;
    block->gathers = true;
  }
  if (block->gathers) PlanRest(plan, block);
}

// Returns a block with the layer, N, border and cost that the rules determine.
inline Block Planned(const Plan& plan, int x, int y, int side) {
  const BlockStats stats = plan.Stats(x, y, side);
  Block block = {};
  block.rect = {x, y, std::min(side, plan.config.width - x),
                std::min(side, plan.config.height - y)};
  const bool subapertures = plan.IsSlices();
  block.layer =
      std::min(LayerOf(subapertures, (subapertures ? stats.r_shown : stats.r_min) / kRadiusOne,
                       stats.has_edge, plan.rules.demand),
               plan.rules.max_layer);
  const int scale = 1 << block.layer;
  const int views = ViewsOf(subapertures, stats.r_max / (kRadiusOne * scale), plan.rules.demand);
  block.n = std::min(int(std::ceil(views * plan.config.tuning.n_scale)), plan.rules.max_n);
  const int margin = kUpsampleBorder[block.layer] / scale;
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
  starfocus::BlockWork work = plan.rules.renderer->measure_work(
      block.rendered, block.border, plan.rules.apertures[block.n], stats.content, block.layer);
  work.upsample = upsampled;
  block.cost = starfocus::PredictTime(plan.config.tuning.timing, work);
  if (starfocus::PsfIndex(stats.r_max) > 0)
    PlanGathering(plan, plan.config.tuning.timing.upsample * upsampled, &block);
  return block;
}

// Returns the smallest cost of all partitions of a block, by recursion: the cost of its parts is
// the sum of their smallest costs.
inline uint64_t LeastCost(const Plan& plan, int x, int y, int side) {
  if (side == kSmallestBlock) return Planned(plan, x, y, side).cost;
  uint64_t split = 0;
  for (int child = 0; child < 4; ++child) {
    const int cx = x + child % 2 * side / 2, cy = y + child / 2 * side / 2;
    if (plan.Inside(cx, cy)) split += LeastCost(plan, cx, cy, side / 2);
  }
  return std::min(split, Planned(plan, x, y, side).cost);
}

}  // namespace test

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
