// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/sweep.h"

#include <algorithm>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "lib/depth/swept.h"
#include "lib/depth/tile_views.h"
#include "simd/depth_kernels.h"
#include "simd/disparities.h"
#include "simd/paths.h"

namespace starfocus {
namespace {

// Selects the views that are assumed to see a pixel.
enum class Seeing {
  kOneSide,  // The views on the side whose views fit the pixel best.
  kAll       // All views except views in which the pixel is known to be hidden.
};

// Fills tile->cost for the pixels of `region`. The caller must have loaded the views around
// `region`, and marked the labels (disparities) that nearer surfaces hide in each view
// (tile_views.h).
void MeasureCosts(const EstimatePlan& plan, const Rect& region, Seeing seeing,
                  const simd::DepthKernels& kernels, TileMemory* tile) {
  const TileViews& views = tile->views;
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  simd::LabelRow row = {};
  row.plane = views.plane;
  row.moves = tile->moves;
  row.labels = labels;
  row.views = static_cast<size_t>(plan.side_views);
  const auto all_views = static_cast<uint16_t>((1U << plan.side_views) - 1);
  if (plan.arms == 0) {
    const bool all = seeing == Seeing::kAll;
    row.sides = {all ? &all_views : plan.sides, all ? 1 : static_cast<size_t>(plan.side_count)};
  }
  row.arms = static_cast<size_t>(plan.arms);
  row.rings = static_cast<size_t>(plan.rings);
  row.one_side = seeing == Seeing::kOneSide;
  row.ends = views.ends;
  // If the views form a star and a pixel moves beyond the edge of a view, the opposite view
  // replaces this view. In an estimate from a star, the opposite view also replaces each view in
  // which a nearer surface hides the pixel. In a repair, such a hidden view remains in use with a
  // limited cost, because the map of a repair may be wrong.
  row.limits = plan.repairs && seeing == Seeing::kAll;
  for (int32_t y = region.y; y < region.y + region.height; ++y) {
    uint8_t* cost =
        tile->cost + static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) * places;
    ForRuns(plan, tile->swept, y, region.x, region.x + region.width,
            [&](int32_t begin, int32_t end) {
              const size_t at = views.At(begin, y);
              row.pixels = views.Centre(0) + at;
              row.hidden = views.all_seen ? nullptr : views.hidden + at;
              kernels.CostLabels(row, static_cast<size_t>(end - begin), places,
                                 cost + static_cast<size_t>(begin - region.x) * places);
            });
  }
}

// A tile of an estimate: the region that consists of the tile and its margin, and the tile's
// memory.
struct EstimateTile {
  const EstimatePlan& plan;
  const Rect& region;
  const simd::DepthKernels& kernels;
  const TileMemory& memory;
};

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

// Computes memory.sum from memory.cost for the pixels of the region.
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

// Writes the disparities (kDisparityBits) of the part `tile_rect` of the region, and the certainty
// of these disparities, to maps of the whole picture. `certainty` may be null.
void ChooseDisparities(const EstimateTile& tile, const Rect& tile_rect, int16_t* disparity,
                       uint8_t* certainty) {
  const EstimatePlan& plan = tile.plan;
  const Rect& region = tile.region;
  const TileMemory& memory = tile.memory;
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    const size_t row = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width);
    const size_t to = plan.At(0, y);
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

// The given map adds no cost to a label whose disparity differs from the pixel's trusted disparity
// by at most kOwnLabels (kDisparityBits).
constexpr int32_t kOwnLabels = 1 << (kDisparityBits - 1);

// Writes the initial prior of one pixel: 0 for the labels near the pixel's disparity, and the
// largest cost for all other labels.
void SeedPrior(const EstimatePlan& plan, int32_t d, size_t places, uint8_t* prior) {
  std::fill_n(prior, places, simd::kMostPrior);
  if (d == simd::kNoSurface) return;
  const int32_t below = d - kOwnLabels - plan.low;
  const int32_t first = below > 0 ? (below + plan.step - 1) / plan.step : 0;
  const int32_t last = Min((d + kOwnLabels - plan.low) / plan.step, plan.labels - 1);
  for (int32_t l = first; l <= last; ++l) prior[l] = 0;
}

// Returns the label nearest to a disparity.
int32_t LabelOf(const EstimatePlan& plan, int32_t d) {
  const int32_t label = (d - plan.low + plan.step / 2) / plan.step;
  return Max(0, Min(label, plan.labels - 1));
}

// Adds a prior cost to the cost of each label at the pixels of `region`. The prior cost of a label
// increases with the distance to the nearest trusted pixel with the label's disparity. `trusted`
// has the size of the picture.
void AddMapPrior(const EstimatePlan& plan, const Rect& region, const int16_t* trusted,
                 const simd::DepthKernels& kernels, TileMemory* tile) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto width = static_cast<size_t>(region.width), height = static_cast<size_t>(region.height);
  const size_t row_places = width * places;
  // Propagates the prior costs of row y along the row in direction `step`. If `goes_on` is true,
  // prior costs are also propagated from row y + from to row y.
  const auto spread = [&](size_t y, bool goes_on, ptrdiff_t step, ptrdiff_t from) {
    uint8_t* prior = tile->prior + y * row_places;
    const ptrdiff_t before = from * static_cast<ptrdiff_t>(row_places);
    const uint8_t* swept = tile->swept + (region.y + static_cast<ptrdiff_t>(y) + from) * plan.width;
    ForRuns(plan, tile->swept, region.y + static_cast<int32_t>(y), region.x,
            region.x + region.width, [&](int32_t begin, int32_t end) {
              // Pixels for which no disparity is searched (swept[x] == 0) contribute no prior
              // costs.
              for (int32_t x = begin; goes_on && x < end; ++x) {
                if (swept[x] != 0) continue;
                std::fill_n(prior + before + (x - region.x) * static_cast<ptrdiff_t>(places),
                            places, simd::kMostPrior);
              }
              uint8_t* first =
                  prior + static_cast<size_t>((step > 0 ? begin : end - 1) - region.x) * places;
              kernels.SpreadPrior({first, goes_on ? first + before : nullptr, places, step,
                                   static_cast<size_t>(end - begin)});
            });
  };
  for (size_t y = 0; y < height; ++y) {
    uint8_t* prior = tile->prior + y * row_places;
    const int32_t row = region.y + static_cast<int32_t>(y);
    const int16_t* disparity = trusted + plan.At(0, row);
    ForRuns(plan, tile->swept, row, region.x, region.x + region.width,
            [&](int32_t begin, int32_t end) {
              for (int32_t x = begin; x < end; ++x) {
                SeedPrior(plan, disparity[x], places,
                          prior + static_cast<size_t>(x - region.x) * places);
              }
            });
    // First spread the prior forwards along row y and from the row above, then backwards along row
    // y.
    spread(y, y > 0, 1, -1);
    spread(y, false, -1, 0);
  }
  for (size_t y = height; y-- > 0;) {
    spread(y, y + 1 < height, -1, 1);
    spread(y, false, 1, 0);
    ForRuns(plan, tile->swept, region.y + static_cast<int32_t>(y), region.x,
            region.x + region.width, [&](int32_t begin, int32_t end) {
              const size_t at = y * row_places + static_cast<size_t>(begin - region.x) * places;
              kernels.AddPrior(tile->prior + at, static_cast<size_t>(end - begin) * places,
                               tile->cost + at);
            });
  }
}

// Fills memory.given_cost with the cost of the given disparity, and memory.found_cost with the
// cost of memory.second, for the pixels of `tile_rect`. The written costs exclude the prior costs
// of AddMapPrior.
void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, const EstimateMemory& memory) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto weigh = [&](int32_t x, int32_t y) {
    const size_t at = plan.At(x, y);
    const int32_t given = memory.given[at];
    const size_t pixel = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) +
                         static_cast<size_t>(x - region.x);
    const uint8_t* cost = tile.cost + pixel * places;
    const uint8_t* prior = tile.prior + pixel * places;
    const int32_t is = LabelOf(plan, memory.second[at]);
    const int32_t was = given == simd::kNoSurface ? is : LabelOf(plan, given);
    memory.given_cost[at] = static_cast<uint8_t>(cost[was] - prior[was]);
    memory.found_cost[at] = static_cast<uint8_t>(cost[is] - prior[is]);
  };
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    ForRuns(plan, tile.swept, y, tile_rect.x, tile_rect.x + tile_rect.width,
            [&](int32_t begin, int32_t end) {
              for (int32_t x = begin; x < end; ++x) weigh(x, y);
            });
  }
}

void SweepTile(const Sweep& sweep, Seeing seeing, int32_t index, int32_t worker, int16_t* disparity,
               uint8_t* certainty) {
  const bool first = seeing == Seeing::kOneSide;
  const EstimatePlan plan = first && sweep.plan.repairs ? CoarsePlan(sweep.plan) : sweep.plan;
  const EstimateMemory& memory = sweep.memory;
  TileMemory& tile = memory.workers[worker];
  const Rect tile_rect = TileOf(plan, index);
  if (tile_rect.width == 0 || tile_rect.height == 0) return;
  const Rect region = RegionOf(plan, index);
  LoadTileViews(plan, sweep.light_field, region, sweep.kernels, &tile.views);
  FindMoves(plan, tile.views, tile.moves);
  if (first) {
    MarkOutside(plan, &tile.views);
  } else if (plan.one_sided()) {
    MarkHiddenInMaps(plan, memory.side_maps, &tile.views);
  } else {
    MarkHidden(plan, memory.first, region, &tile.views);
  }
  MeasureCosts(plan, region, seeing, sweep.kernels, &tile);
  if (plan.repairs) AddMapPrior(plan, region, memory.trusted, sweep.kernels, &tile);
  const EstimateTile of_tile = {plan, region, sweep.kernels, tile};
  AddAllPaths(of_tile);
  ChooseDisparities(of_tile, tile_rect, disparity, certainty);
  if (plan.repairs && !first) WeighEvidence(plan, region, tile_rect, tile, memory);
}

}  // namespace

TileMemory TakeTileMemory(const EstimatePlan& plan, const Rect& region, Arena* arena) {
  const auto width = static_cast<size_t>(region.width);
  const size_t area = width * static_cast<size_t>(region.height);
  const auto labels = static_cast<size_t>(plan.labels), places = simd::PathLabels(labels);
  TileMemory tile = {};
  tile.views = TakeTileViews(plan, region, arena);
  tile.cost = arena->Take<uint8_t>(area, places);
  tile.prior = plan.repairs ? arena->Take<uint8_t>(area, places) : nullptr;
  tile.sum = arena->Take<int16_t>(area, places);
  for (int k = 0; k < 2; ++k) {
    int16_t* path = arena->Take<int16_t>((width + 2) * places + 1);
    tile.path[k] = path == nullptr ? nullptr : path + places + 1;
    int16_t* least = arena->Take<int16_t>(width + 2);
    tile.least[k] = least == nullptr ? nullptr : least + 1;
  }
  tile.jump = arena->Take<int16_t>(width);
  tile.moves = arena->Take<simd::ViewMove>(labels, static_cast<size_t>(plan.side_views));
  tile.choice = arena->Take<int16_t>(width);
  return tile;
}

void SweepOneSide(const Sweep& sweep, int32_t index, int32_t worker, int16_t* disparity) {
  SweepTile(sweep, Seeing::kOneSide, index, worker, disparity, nullptr);
}

void SweepAllViews(const Sweep& sweep, int32_t index, int32_t worker, uint8_t* certainty) {
  SweepTile(sweep, Seeing::kAll, index, worker, sweep.memory.second, certainty);
}

}  // namespace starfocus
