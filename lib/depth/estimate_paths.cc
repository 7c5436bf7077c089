// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_paths.h"

#include <algorithm>

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// What a jump to another disparity costs between pixels of one colour, and at least; by the
// difference of their colours it grows less like an inverse of it.
constexpr int32_t kLargestJump = 400, kLeastJump = 128, kSimilarColours = 16;

// A direction that paths go in.
struct Direction {
  int32_t x, y;
};
constexpr Direction kDirections[8] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                                      {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};

// What jumps cost between each pixel of a row and the one before it on the path.
void FindJumps(const Rect& region, int32_t y, const Direction& direction, const Patches& patches,
               int16_t* jump) {
  const int32_t first = direction.x > 0 ? 1 : 0;
  const int32_t last = region.width - (direction.x < 0 ? 1 : 0);
  for (int32_t k = first; k < last; ++k) {
    int32_t apart = 0;
    for (int32_t c = 0; c < 3; ++c) {
      const uint8_t* here = patches.Plane(0, c) + patches.At(region.x + k, y);
      const uint8_t* before =
          patches.Plane(0, c) + patches.At(region.x + k - direction.x, y - direction.y);
      apart += std::abs(*here - *before);
    }
    const int32_t cost = kLargestJump * kSimilarColours / (kSimilarColours + apart);
    jump[k] = static_cast<int16_t>(Max(cost, kLeastJump));
  }
}

// Rows of paths: of the row before, and of this one.
struct PathRows {
  int16_t* path[2];
  int16_t* least[2];
};

// Adds the paths of row y of the region, which begin here or go on from those of the row before.
void AddRow(const EstimatePlan& plan, const Rect& region, int32_t y, const Direction& direction,
            const simd::DepthKernels& kernels, const PathRows& rows, const TileMemory& tile) {
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  const auto width = static_cast<ptrdiff_t>(region.width);
  const ptrdiff_t row = static_cast<ptrdiff_t>(y - region.y) * width;
  const bool along = direction.y == 0;
  const bool begins = !along && y == (direction.y > 0 ? region.y : region.y + region.height - 1);
  const auto step = direction.x < 0 ? ptrdiff_t{-1} : ptrdiff_t{1};
  // Adds `count` pixels from pixel k of the row on.
  const auto add = [&](ptrdiff_t k, ptrdiff_t count, bool first) {
    const auto stride = static_cast<ptrdiff_t>(places);
    simd::PathRow paths = {};
    paths.cost = tile.cost + (row + k) * stride;
    paths.sum = tile.sum + (row + k) * stride;
    paths.path = rows.path[1] + k * stride;
    paths.least = rows.least[1] + k;
    paths.jump = tile.jump + k;
    if (!first) {
      const int from = along ? 1 : 0;
      paths.before = rows.path[from] + (k - direction.x) * stride;
      paths.before_least = rows.least[from] + k - direction.x;
    }
    kernels.AddPaths(paths, labels, step, static_cast<size_t>(count));
  };
  const ptrdiff_t edge = step > 0 ? 0 : width - 1;
  if (begins) {
    add(edge, width, true);
    return;
  }
  FindJumps(region, y, direction, tile.patches, tile.jump);
  if (direction.x == 0) {
    add(edge, width, false);
    return;
  }
  add(edge, 1, true);
  if (width > 1) add(edge + step, width - 1, false);
}

int16_t ToDisparity(const EstimatePlan& plan, int32_t choice) {
  const int32_t moved = (choice * plan.step + (1 << (simd::kChoiceBits - 1))) >> simd::kChoiceBits;
  return static_cast<int16_t>(plan.low + moved);
}

}  // namespace

void AddAllPaths(const EstimatePlan& plan, const Rect& region, const simd::DepthKernels& kernels,
                 TileMemory* tile) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto area = static_cast<size_t>(region.width) * static_cast<size_t>(region.height);
  std::fill_n(tile->sum, area * places, int16_t{0});
  for (int32_t n = 0; n < plan.directions; ++n) {
    const Direction& direction = kDirections[n];
    PathRows rows = {{tile->path[0], tile->path[1]}, {tile->least[0], tile->least[1]}};
    for (int32_t k = 0; k < region.height; ++k) {
      const int32_t y = region.y + (direction.y < 0 ? region.height - 1 - k : k);
      AddRow(plan, region, y, direction, kernels, rows, *tile);
      std::swap(rows.path[0], rows.path[1]);
      std::swap(rows.least[0], rows.least[1]);
    }
  }
}

void ChooseDisparities(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                       const simd::DepthKernels& kernels, const TileMemory& tile,
                       int16_t* disparity, uint8_t* certainty) {
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  const auto count = static_cast<size_t>(tile_rect.width);
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    const size_t from = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) +
                        static_cast<size_t>(tile_rect.x - region.x);
    const size_t to =
        static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(tile_rect.x);
    kernels.ChooseLabels(tile.sum + from * places, labels, count, tile.choice, tile.margin);
    for (size_t k = 0; k < count; ++k) disparity[to + k] = ToDisparity(plan, tile.choice[k]);
    if (certainty != nullptr) std::copy_n(tile.margin, count, certainty + to);
  }
}

}  // namespace starfocus
