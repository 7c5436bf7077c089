// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/engine_blocks.h"

#include <algorithm>

#include "starfocus/starfocus.hpp"
#include "tests/support/inside.h"

namespace conformance {
namespace {

// Converts the rectangle of a cell, which is blurred without rendering views, to pixels at the
// layer of the cell's block. At the sides of the block, the rectangle includes the margin that
// upsampling reads.
void AtLayer(const starfocus::Block& block, reference::GatheredCell* cell) {
  const int scale = 1 << block.layer, margin = block.layer == 0 ? 0 : block.layer + 1;
  const starfocus::Rect& rect = block.rect;
  const auto find = [&](int from, int size, int first, int all, int* at, int* at_size) {
    *at = from / scale - (from == first ? margin : 0);
    const int end = from + size;
    *at_size = (end + scale - 1) / scale + (end == first + all ? margin : 0) - *at;
  };
  find(cell->x, cell->width, rect.x, rect.width, &cell->at_x, &cell->at_width);
  find(cell->y, cell->height, rect.y, rect.height, &cell->at_y, &cell->at_height);
}

std::vector<reference::GatheredCell> GatheredCells(const starfocus::GatherMap& map,
                                                   const starfocus::Block& block) {
  std::vector<reference::GatheredCell> cells;
  if (!block.gathers) return cells;
  constexpr int kSide = starfocus::kCellSize;
  const int right = block.rect.x + block.rect.width, bottom = block.rect.y + block.rect.height;
  for (int y = block.rect.y; y < bottom; y += kSide) {
    for (int x = block.rect.x; x < right; x += kSide) {
      if (map.FirstLayer(x, y) > block.layer) continue;
      const bool on_slope = (map.At(x, y) & starfocus::kSlopeMark) != 0;
      cells.push_back(
          {x, y, std::min(kSide, right - x), std::min(kSide, bottom - y), on_slope, 0, 0, 0, 0});
      AtLayer(block, &cells.back());
    }
  }
  return cells;
}

// Block visitor that collects the engine's blocks for the reference. The engine calls the visitor
// while the plan of the block's stripe is in memory.
struct Visit {
  starfocus_engine* engine;
  std::vector<reference::Block>* blocks;

  static void Add(void* self, const starfocus_block* told) {
    const auto& visit = *static_cast<const Visit*>(self);
    const test::StripeBlocks plan = test::PlanOf(visit.engine);
    const starfocus::Block& b = *std::find_if(
        plan.blocks.begin(), plan.blocks.end(),
        [&](const auto& block) { return block.rect.x == told->x && block.rect.y == told->y; });
    visit.blocks->push_back({b.rect.x, b.rect.y, b.rect.width, b.rect.height, b.layer, b.n,
                             b.rendered.x, b.rendered.y, b.rendered.width, b.rendered.height,
                             b.border.left, b.border.right, b.border.top, b.border.bottom,
                             GatheredCells(plan.gathered, b)});
  }
};

}  // namespace

EngineResult RunEngine(const test::Scene& scene, const starfocus::Params& params,
                       const starfocus::simd::Kernels& kernels, test::Engine* engine) {
  EngineResult result;
  test::UseKernels(&kernels, engine->get());
  Visit visit = {engine->get(), &result.blocks};
  test::Output out(scene.width, scene.height);
  const starfocus_observer observer = test::Visitor(Visit::Add, &visit);
  result.status =
      test::Refocus(engine, params, scene, &out, test::ObservedBy(&observer), &result.report);
  result.bytes = out.Tight();
  return result;
}

}  // namespace conformance
