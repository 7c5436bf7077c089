// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_paths.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/swept.h"

namespace starfocus {
namespace {

// Direction of a path, as the difference between a pixel and the previous pixel of the path.
struct PathStep {
  int32_t x, y;
};
constexpr PathStep kDirections[8] = {{1, 0}, {-1, 0},  {0, 1},  {0, -1},
                                     {1, 1}, {-1, -1}, {1, -1}, {-1, 1}};

// Path costs of the previous row (index 0) and of the current row (index 1).
struct PathRows {
  int16_t* path[2];
  int16_t* least[2];
};

// Starts paths at pixel k of a row, with a cost of 0 for all labels.
void BeginAt(const PathRows& rows, int from, size_t labels, int32_t k) {
  const size_t places = simd::PathLabels(labels);
  int16_t* path = rows.path[from] + k * static_cast<ptrdiff_t>(places);
  std::fill_n(path, labels, int16_t{0});
  std::fill(path + labels, path + places, simd::kNoLabel);
  rows.least[from][k] = 0;
}

// Starts paths at all pixels of row y in columns [first, last) that are not swept.
void BeginBeside(const EstimateTile& tile, int32_t y, int32_t first, int32_t last,
                 const PathRows& rows) {
  const EstimatePlan& plan = tile.plan;
  const Rect& region = tile.region;
  const uint8_t* all_swept = tile.memory.swept;
  const bool inside = y >= region.y && y < region.y + region.height;
  const uint8_t* swept =
      all_swept == nullptr || !inside ? nullptr : all_swept + ptrdiff_t{y} * plan.width;
  for (int32_t x = first; x < last; ++x) {
    const bool goes_on = inside && x >= region.x && x < region.x + region.width &&
                         (swept == nullptr || swept[x] != 0);
    if (!goes_on) BeginAt(rows, 0, static_cast<size_t>(plan.labels), x - region.x);
  }
}

// Adds the path costs of row y of the region to the sums. The paths continue from the swept pixels
// of the previous row. If `adds` is false, the sums are overwritten.
void AddRow(const EstimateTile& tile, int32_t y, const PathStep& direction, bool adds,
            const PathRows& rows) {
  const EstimatePlan& plan = tile.plan;
  const Rect& region = tile.region;
  const TileMemory& memory = tile.memory;
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  const auto stride = static_cast<ptrdiff_t>(places);
  const ptrdiff_t row = ptrdiff_t{y - region.y} * region.width;
  const int from = direction.y == 0 ? 1 : 0;
  const int32_t right = region.x + region.width;
  ForRuns(plan, memory.swept, y, region.x, right, [&](int32_t begin, int32_t end) {
    const ptrdiff_t k = (direction.x < 0 ? end - 1 : begin) - region.x;
    if (direction.y == 0) {
      BeginAt(rows, from, labels, static_cast<int32_t>(k) - direction.x);
    } else {
      BeginBeside(tile, y - direction.y, begin - direction.x, end - direction.x, rows);
    }
    const auto count = static_cast<size_t>(end - begin);
    const TileViews& views = memory.views;
    tile.kernels.FindJumps(views.Centre(0) + views.At(begin, y),
                           views.Centre(0) + views.At(begin - direction.x, y - direction.y),
                           views.plane, count, memory.jump + (begin - region.x));
    simd::PathRow paths = {};
    paths.cost = memory.cost + (row + k) * stride;
    paths.sum = memory.sum + (row + k) * stride;
    paths.adds = adds;
    paths.path = rows.path[1] + k * stride;
    paths.least = rows.least[1] + k;
    paths.jump = memory.jump + k;
    paths.before = rows.path[from] + (k - direction.x) * stride;
    paths.before_least = rows.least[from] + k - direction.x;
    tile.kernels.AddPaths(paths, labels, direction.x < 0 ? -1 : 1, count);
  });
}

int16_t ToDisparity(const EstimatePlan& plan, int32_t choice) {
  const int32_t moved = (choice * plan.step + (1 << (simd::kChoiceBits - 1))) >> simd::kChoiceBits;
  return static_cast<int16_t>(plan.low + moved);
}

}  // namespace

void AddAllPaths(const EstimateTile& tile) {
  const EstimatePlan& plan = tile.plan;
  const Rect& region = tile.region;
  const TileMemory& memory = tile.memory;
  // Set the element before each pixel's first label to kNoLabel, because this element belongs to no
  // label.
  const auto places = static_cast<ptrdiff_t>(simd::PathLabels(static_cast<size_t>(plan.labels)));
  for (int16_t* path : memory.path) {
    for (ptrdiff_t k = -1; k <= region.width; ++k) path[k * places - 1] = simd::kNoLabel;
  }
  for (int32_t n = 0; n < plan.directions; ++n) {
    const PathStep& direction = kDirections[n];
    PathRows rows = {{memory.path[0], memory.path[1]}, {memory.least[0], memory.least[1]}};
    for (int32_t k = 0; k < region.height; ++k) {
      const int32_t y = region.y + (direction.y < 0 ? region.height - 1 - k : k);
      AddRow(tile, y, direction, n > 0, rows);
      std::swap(rows.path[0], rows.path[1]);
      std::swap(rows.least[0], rows.least[1]);
    }
  }
}

void ChooseDisparities(const EstimateTile& tile, const Rect& tile_rect, int16_t* disparity,
                       uint8_t* certainty) {
  const EstimatePlan& plan = tile.plan;
  const Rect& region = tile.region;
  const TileMemory& memory = tile.memory;
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    const size_t row = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width);
    const size_t to = static_cast<size_t>(y) * static_cast<size_t>(plan.width);
    ForRuns(plan, memory.swept, y, tile_rect.x, tile_rect.x + tile_rect.width,
            [&](int32_t begin, int32_t end) {
              const auto count = static_cast<size_t>(end - begin);
              const size_t from = row + static_cast<size_t>(begin - region.x);
              tile.kernels.ChooseLabels(memory.sum + from * places, labels, count, memory.choice,
                                        certainty == nullptr ? nullptr : certainty + to + begin);
              int16_t* out = disparity + to + begin;
              for (size_t k = 0; k < count; ++k) out[k] = ToDisparity(plan, memory.choice[k]);
            });
  }
}

}  // namespace starfocus
