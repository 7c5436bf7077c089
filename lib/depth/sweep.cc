// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/sweep.h"

#include "lib/depth/estimate_cost.h"
#include "lib/depth/estimate_paths.h"
#include "lib/depth/map_prior.h"
#include "lib/depth/tile_views.h"

namespace starfocus {
namespace {

void SweepTile(const Sweep& sweep, Seeing seeing, int32_t index, int32_t worker) {
  const bool first = seeing == Seeing::kOneSide;
  const EstimatePlan plan = first && sweep.plan.repairs ? CoarsePlan(sweep.plan) : sweep.plan;
  EstimateMemory& memory = *sweep.memory;
  TileMemory& tile = memory.workers[worker];
  const Rect tile_rect = TileOf(plan, index);
  if (tile_rect.width == 0 || tile_rect.height == 0) return;
  const Rect region = RegionOf(plan, index);
  LoadTileViews(plan, sweep.light_field, region, sweep.kernels, &tile.views);
  FindMoves(plan, tile.views, tile.moves);
  if (first) {
    MarkOutside(plan, &tile.views);
  } else if (plan.one_sided()) {
    MarkHiddenInMaps(plan, memory, &tile.views);
  } else {
    MarkHidden(plan, memory.first, region, &tile.views);
  }
  MeasureCosts(plan, region, seeing, sweep.kernels, &tile);
  if (plan.repairs) AddMapPrior(plan, region, memory.trusted, sweep.kernels, &tile);
  const EstimateTile of_tile = {plan, region, sweep.kernels, tile};
  AddAllPaths(of_tile);
  ChooseDisparities(of_tile, tile_rect, first ? sweep.one_side : memory.second,
                    first || !sweep.rates ? nullptr : memory.certainty);
  if (plan.repairs && !first) WeighEvidence(plan, region, tile_rect, tile, &memory);
}

}  // namespace

void SweepOneSide(const void* data, int32_t index, int32_t worker) {
  SweepTile(*static_cast<const Sweep*>(data), Seeing::kOneSide, index, worker);
}

void SweepAllViews(const void* data, int32_t index, int32_t worker) {
  SweepTile(*static_cast<const Sweep*>(data), Seeing::kAll, index, worker);
}

}  // namespace starfocus
