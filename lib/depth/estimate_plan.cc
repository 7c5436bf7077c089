// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_plan.h"

#include <cmath>
#include <cstdlib>

#include "lib/base/fixed.h"
#include "lib/input/window.h"

namespace starfocus {
namespace {

// Directions from the centre view to side views, in the order of their angles. Every second
// direction lies along an axis.
constexpr int8_t kDirections[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                      {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

void OrderViews(int32_t views, EstimatePlan* plan) {
  plan->arms = views == 5 ? 4 : 8;
  plan->rings = views == 17 ? 2 : 1;
  for (int32_t k = 0; k < plan->side_views(); ++k) {
    const bool half = k >= plan->arms;
    const int8_t* direction = kDirections[(k % plan->arms) * (8 / plan->arms)];
    const int32_t size = half ? 1 : 2;
    const int index = CapturedView(direction[0], direction[1], half);
    plan->side[k] = {index, size * direction[0], size * direction[1]};
  }
}

}  // namespace

int32_t TilesAlong(int32_t length, int32_t side) {
  return (length + side / 2) / (2 * side) * 2 + 1;
}

int32_t TileBegin(int32_t length, int32_t count, int32_t k) {
  const auto at = [&](int32_t tile) {
    return static_cast<int32_t>(int64_t{length} * tile / count);
  };
  return k <= count / 2 ? at(k) : length - at(count - k);
}

int32_t EstimatePlan::Phases(const SideView& view) const {
  const int32_t move = step * Max(std::abs(view.u2), std::abs(view.v2));
  int32_t phases = 1;
  while (phases * move % 128 != 0) phases *= 2;
  return phases;
}

int32_t EstimatePlan::AllPhases() const {
  int32_t phases = 0;
  for (int32_t view = 0; view < side_views(); ++view) phases += Phases(side[view]);
  return phases;
}

EstimatePlan MakePlan(const starfocus_depth_config& config) {
  EstimatePlan plan = {};
  plan.width = config.width;
  plan.height = config.height;
  constexpr float kScale = 1 << kDisparityBits;
  plan.low = static_cast<int32_t>(std::floor(static_cast<float>(config.disparity_min) * kScale));
  const auto high =
      static_cast<int32_t>(std::ceil(static_cast<float>(config.disparity_max) * kScale));
  const int32_t range = high - plan.low;
  const int32_t least = (range + kMostLabels - 2) / (kMostLabels - 1);
  plan.step = Max(1, (least + kLabelStep - 1) / kLabelStep) * kLabelStep;
  plan.labels = (range + plan.step - 1) / plan.step + 1;
  const int32_t last = plan.Disparity(plan.labels - 1);
  const int32_t farthest = -plan.low > last ? -plan.low : last;
  plan.reach = (farthest >> kDisparityBits) + 2;
  plan.directions = 8;
  OrderViews(config.views, &plan);
  plan.columns = TilesAlong(config.width, kTileSide);
  plan.rows = TilesAlong(config.height, kTileSide);
  return plan;
}

EstimatePlan CoarsePlan(const EstimatePlan& plan) {
  EstimatePlan coarse = plan;
  coarse.step = 2 * plan.step;
  coarse.labels = (plan.labels + 1) / 2;
  coarse.directions = 4;
  return coarse;
}

Rect TileOf(const EstimatePlan& plan, int32_t index) {
  const int32_t column = index % plan.columns, row = index / plan.columns;
  const int32_t x = TileBegin(plan.width, plan.columns, column);
  const int32_t y = TileBegin(plan.height, plan.rows, row);
  return {x, y, TileBegin(plan.width, plan.columns, column + 1) - x,
          TileBegin(plan.height, plan.rows, row + 1) - y};
}

Rect RegionOf(const EstimatePlan& plan, int32_t index) {
  return Widened(plan, TileOf(plan, index), plan.repairs ? kRepairMargin : kTileMargin);
}

Rect Widened(const EstimatePlan& plan, const Rect& rect, int32_t margin) {
  const int32_t left = rect.x > margin ? rect.x - margin : 0;
  const int32_t top = rect.y > margin ? rect.y - margin : 0;
  const int32_t right = rect.x + rect.width + margin, bottom = rect.y + rect.height + margin;
  return {left, top, (right < plan.width ? right : plan.width) - left,
          (bottom < plan.height ? bottom : plan.height) - top};
}

}  // namespace starfocus
