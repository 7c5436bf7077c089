// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/map_prior.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "simd/disparities.h"
#include "simd/paths.h"

namespace starfocus {
namespace {

// Labels this near to a trusted disparity are its own, kDisparityBits.
constexpr int32_t kOwnLabels = 1 << (kDisparityBits - 1);

// Sets the prior of one pixel by itself: nothing for the labels of its disparity.
void SeedPrior(const EstimatePlan& plan, int32_t d, size_t places, uint8_t* prior) {
  std::fill_n(prior, places, simd::kMostPrior);
  if (d == simd::kNoSurface) return;
  const int32_t below = d - kOwnLabels - plan.low;
  const int32_t first = below > 0 ? (below + plan.step - 1) / plan.step : 0;
  const int32_t last = Min((d + kOwnLabels - plan.low) / plan.step, plan.labels - 1);
  for (int32_t l = first; l <= last; ++l) prior[l] = 0;
}

// The label next to a disparity.
int32_t LabelOf(const EstimatePlan& plan, int32_t d) {
  const int32_t label = (d - plan.low + plan.step / 2) / plan.step;
  return Max(0, Min(label, plan.labels - 1));
}

}  // namespace

void AddMapPrior(const EstimatePlan& plan, const Rect& region, const int16_t* trusted,
                 const simd::DepthKernels& kernels, TileMemory* tile) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto width = static_cast<size_t>(region.width), height = static_cast<size_t>(region.height);
  const size_t row_places = width * places;
  for (size_t y = 0; y < height; ++y) {
    uint8_t* prior = tile->prior + y * row_places;
    const size_t from = (static_cast<size_t>(region.y) + y) * static_cast<size_t>(plan.width) +
                        static_cast<size_t>(region.x);
    for (size_t x = 0; x < width; ++x) {
      SeedPrior(plan, trusted[from + x], places, prior + x * places);
    }
    // Forwards along this row by what lies above, and backwards by the row alone.
    const uint8_t* above = y > 0 ? prior - row_places : nullptr;
    kernels.SpreadPrior({prior, above, places, 1, width});
    kernels.SpreadPrior({prior + row_places - places, nullptr, places, -1, width});
  }
  for (size_t y = height; y-- > 0;) {
    uint8_t* last = tile->prior + (y + 1) * row_places - places;
    const uint8_t* below = y + 1 < height ? last + row_places : nullptr;
    kernels.SpreadPrior({last, below, places, -1, width});
    kernels.SpreadPrior({tile->prior + y * row_places, nullptr, places, 1, width});
  }
  kernels.AddPrior(tile->prior, height * row_places, tile->cost);
}

void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, EstimateMemory* memory) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    for (int32_t x = tile_rect.x; x < tile_rect.x + tile_rect.width; ++x) {
      const size_t at =
          static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x);
      const int32_t given = memory->given[at];
      memory->evidence[at] = 0;
      if (given == simd::kNoSurface) continue;
      const size_t pixel = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) +
                           static_cast<size_t>(x - region.x);
      const uint8_t* cost = tile.cost + pixel * places;
      const uint8_t* prior = tile.prior + pixel * places;
      const int32_t was = LabelOf(plan, given), is = LabelOf(plan, memory->second[at]);
      memory->evidence[at] =
          static_cast<int16_t>((cost[was] - prior[was]) - (cost[is] - prior[is]));
    }
  }
}

}  // namespace starfocus
