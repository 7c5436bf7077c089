// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_cost.h"

#include "lib/depth/swept.h"

namespace starfocus {
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

}  // namespace starfocus
