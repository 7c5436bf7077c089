// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/map_prior.h"

#include <algorithm>

#include "lib/base/fixed.h"
#include "lib/depth/swept.h"
#include "simd/disparities.h"
#include "simd/paths.h"

namespace starfocus {
namespace {

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

}  // namespace

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
    const auto row = static_cast<size_t>(region.y) + y;
    const int16_t* disparity = trusted + row * static_cast<size_t>(plan.width);
    ForRuns(plan, tile->swept, static_cast<int32_t>(row), region.x, region.x + region.width,
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

void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, EstimateMemory* memory) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto weigh = [&](int32_t x, int32_t y) {
    const size_t at =
        static_cast<size_t>(y) * static_cast<size_t>(plan.width) + static_cast<size_t>(x);
    const int32_t given = memory->given[at];
    const size_t pixel = static_cast<size_t>(y - region.y) * static_cast<size_t>(region.width) +
                         static_cast<size_t>(x - region.x);
    const uint8_t* cost = tile.cost + pixel * places;
    const uint8_t* prior = tile.prior + pixel * places;
    const int32_t is = LabelOf(plan, memory->second[at]);
    const int32_t was = given == simd::kNoSurface ? is : LabelOf(plan, given);
    memory->given_cost[at] = static_cast<uint8_t>(cost[was] - prior[was]);
    memory->found_cost[at] = static_cast<uint8_t>(cost[is] - prior[is]);
  };
  for (int32_t y = tile_rect.y; y < tile_rect.y + tile_rect.height; ++y) {
    ForRuns(plan, tile.swept, y, tile_rect.x, tile_rect.x + tile_rect.width,
            [&](int32_t begin, int32_t end) {
              for (int32_t x = begin; x < end; ++x) weigh(x, y);
            });
  }
}

}  // namespace starfocus
