// SPDX-License-Identifier: Apache-2.0
#include <new>

#include "lib/base/fixed.h"
#include "lib/depth/maps.h"
#include "simd/paths.h"

namespace starfocus {
namespace {

// Returns the largest width and the largest height of all tiles with their margins.
Rect LargestRegion(const EstimatePlan& plan) {
  Rect largest = {0, 0, 0, 0};
  for (int32_t tile = 0; tile < plan.columns * plan.rows; ++tile) {
    const Rect region = RegionOf(plan, tile);
    largest.width = Max(largest.width, region.width);
    largest.height = Max(largest.height, region.height);
  }
  return largest;
}

TileMemory TakeTile(const EstimatePlan& plan, const Rect& region, Arena* arena) {
  TileMemory tile = {};
  const auto width = static_cast<size_t>(region.width), height = static_cast<size_t>(region.height);
  const size_t area = width * height, places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto side_views = static_cast<size_t>(plan.side_views);
  const auto beyond = 2 * static_cast<size_t>(plan.reach) + 1;
  TileViews& views = tile.views;
  views.stride = simd::SliceSamples(width + beyond) + simd::kPadding;
  views.plane = views.stride * (height + beyond);
  views.rgb = arena->Take<uint8_t>(views.plane, 3 * (static_cast<size_t>(plan.AllPhases()) + 1));
  views.split = arena->Take<uint8_t>(views.stride, 2 * 3);
  views.hidden = arena->Take<uint8_t>(views.plane, side_views);
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
  tile.moves = arena->Take<simd::ViewMove>(static_cast<size_t>(plan.labels), side_views);
  tile.choice = arena->Take<int16_t>(width);
  return tile;
}

}  // namespace

size_t LayOutEstimate(const EstimatePlan& plan, int32_t max_workers, void* base,
                      EstimateMemory** memory, const PieceVisitor* pieces) {
  Arena arena(base, PTRDIFF_MAX, pieces);
  const auto width = static_cast<size_t>(plan.width), height = static_cast<size_t>(plan.height);
  *memory = arena.Take<EstimateMemory>(1);
  const auto tiles = static_cast<size_t>(plan.columns) * static_cast<size_t>(plan.rows);
  auto* progress = arena.Take<std::atomic<uint32_t>>(ProgressWords(tiles));
  auto* first = arena.Take<int16_t>(width, height);
  auto* second = arena.Take<int16_t>(width, height);
  auto* certainty = arena.Take<uint8_t>(width, height);
  int16_t* side_maps =
      plan.one_sided() ? arena.Take<int16_t>(width * height, static_cast<size_t>(plan.side_views))
                       : nullptr;
  int16_t* of_given[2] = {};
  for (int16_t*& map : of_given) map = plan.repairs ? arena.Take<int16_t>(width, height) : nullptr;
  uint8_t* of_pixels[3] = {};
  for (uint8_t*& map : of_pixels) map = plan.repairs ? arena.Take<uint8_t>(width, height) : nullptr;
  ThinCells cells[2] = {};
  if (plan.repairs) {
    for (ThinCells& map : cells) map = TakeThinCells(GridOf(plan), &arena);
  }
  TileCount* counts = plan.repairs ? arena.Take<TileCount>(tiles) : nullptr;
  auto* workers = arena.Take<TileMemory>(static_cast<size_t>(max_workers));
  if (base != nullptr) {
    EstimateMemory& made = *new (*memory) EstimateMemory();
    made.jobs.max_workers = max_workers;
    made.jobs.progress = progress;
    made.first = first;
    made.second = second;
    made.certainty = certainty;
    made.side_maps = side_maps;
    made.given = of_given[0];
    made.trusted = of_given[1];
    made.given_cost = of_pixels[0];
    made.found_cost = of_pixels[1];
    made.doubt = certainty;
    made.swept = of_pixels[2];
    made.given_cells = cells[0];
    made.found_cells = cells[1];
    made.counts = counts;
    made.workers = workers;
  }
  const Rect region = LargestRegion(plan);
  for (int32_t worker = 0; worker < max_workers; ++worker) {
    const TileMemory tile = TakeTile(plan, region, &arena);
    if (base == nullptr) continue;
    workers[worker] = tile;
    workers[worker].swept = of_pixels[2];
  }
  return arena.Bytes();
}

EstimateZones::EstimateZones(const EstimatePlan& plan, int32_t max_workers, void* base)
    : plan_(plan), max_workers_(max_workers), base_(base) {
  Visit({PoisonZone, base});
}

EstimateZones::~EstimateZones() { Visit({UnpoisonZone, base_}); }

void EstimateZones::Visit(const PieceVisitor& visitor) const {
  if (kRedZone == 0) return;
  EstimateMemory* counted = nullptr;
  LayOutEstimate(plan_, max_workers_, nullptr, &counted, &visitor);
}

}  // namespace starfocus
