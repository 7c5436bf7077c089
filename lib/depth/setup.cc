// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/setup.h"

#include <algorithm>
#include <cmath>

namespace starfocus {
namespace {

void OrderStar(int32_t views, SweepSetup* setup) {
  setup->arms = views == 5 ? 4 : 8;
  setup->rings = views == 17 ? 2 : 1;
  for (int32_t k = 0; k < setup->side_views; ++k) {
    const bool half = k >= setup->arms;
    const int8_t* direction = kEightDirections[(k % setup->arms) * (8 / setup->arms)];
    const int index = CapturedView(direction[0], direction[1], half);
    setup->side[k] = {index, StarPosition(index)};
  }
}

// Returns the mask of the side views whose directions differ by less than a right angle from
// `direction`.
uint16_t SideTowards(const SweepSetup& setup, const int8_t* direction) {
  uint32_t mask = 0;
  for (int32_t k = 0; k < setup.side_views; ++k) {
    const ViewPosition& at = setup.side[k].at;
    if (at.u * direction[0] + at.v * direction[1] > 0) mask |= 1U << k;
  }
  return static_cast<uint16_t>(mask);
}

// Adds the sides of the views. A side whose views all belong to another side is left out.
void FindSides(SweepSetup* setup) {
  uint16_t masks[kMostSides];
  for (int32_t k = 0; k < kMostSides; ++k) masks[k] = SideTowards(*setup, kEightDirections[k]);
  for (int32_t k = 0; k < kMostSides; ++k) {
    bool needed = masks[k] != 0;
    for (int32_t other = 0; other < kMostSides; ++other) {
      const bool within = (masks[k] & ~masks[other]) == 0;
      if (within && (masks[k] != masks[other] || other < k)) needed = false;
    }
    if (needed) setup->sides[setup->side_count++] = masks[k];
  }
}

void SetViews(const ViewSet& views, SweepSetup* setup) {
  setup->side_views = views.count - 1;
  if (views.star) return OrderStar(views.count, setup);
  for (int32_t k = 0; k < setup->side_views; ++k) setup->side[k] = {k + 1, views.at[k + 1]};
  FindSides(setup);
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

LabelMove SweepSetup::MoveOf(const SideView& view, int32_t l) const {
  constexpr int32_t kQuarterBits = 2, kQuarter = kMoveOne >> kQuarterBits;
  const int32_t across = MoveBy(view.at.u, l * step, kQuarterBits);
  const int32_t down = MoveBy(view.at.v, l * step, kQuarterBits);
  return {MoveAcross(view, low) + kQuarter * across, MoveDown(view, low) + kQuarter * down,
          (across & 3) + 4 * (down & 3)};
}

ViewPhases SweepSetup::PhasesOf(const SideView& view) const {
  ViewPhases phases;
  std::fill_n(phases.slot, kMostPhases, int8_t{-1});
  for (int32_t l = 0; l < labels; ++l) {
    const LabelMove move = MoveOf(view, l);
    int8_t& slot = phases.slot[move.phase];
    if (slot >= 0) continue;
    slot = static_cast<int8_t>(phases.count);
    phases.move[phases.count++] = move;
  }
  return phases;
}

int32_t SweepSetup::AllPhases() const {
  int32_t phases = 0;
  for (int32_t view = 0; view < side_views; ++view) phases += PhasesOf(side[view]).count;
  return phases;
}

SweepSetup MakeSetup(const FullConfig& config, bool repairs) {
  SweepSetup setup = {};
  setup.width = config.width;
  setup.height = config.height;
  setup.repairs = repairs;
  constexpr float kScale = 1 << kDisparityBits;
  setup.low = static_cast<int32_t>(std::floor(MinDisparity(config) * kScale));
  const auto high = static_cast<int32_t>(std::ceil(MaxDisparity(config) * kScale));
  const int32_t range = high - setup.low;
  const int32_t least = (range + kMostLabels - 2) / (kMostLabels - 1);
  setup.step = Max(1, (least + kLabelStep - 1) / kLabelStep) * kLabelStep;
  setup.labels = (range + setup.step - 1) / setup.step + 1;
  const int32_t last = setup.Disparity(setup.labels - 1);
  const int32_t farthest = -setup.low > last ? -setup.low : last;
  setup.reach = (farthest >> kDisparityBits) + 2;
  setup.directions = 8;
  ViewSet views;
  FindViews(config.views, config.positions, config.problem, &views);
  SetViews(views, &setup);
  setup.columns = TilesAlong(config.width, kTileSide);
  setup.rows = TilesAlong(config.height, kTileSide);
  return setup;
}

SweepSetup CoarseSetup(const SweepSetup& setup) {
  SweepSetup coarse = setup;
  coarse.step = 2 * setup.step;
  coarse.labels = (setup.labels + 1) / 2;
  coarse.directions = 4;
  return coarse;
}

Rect TileOf(const SweepSetup& setup, int32_t index) {
  const int32_t column = index % setup.columns, row = index / setup.columns;
  const int32_t x = TileBegin(setup.width, setup.columns, column);
  const int32_t y = TileBegin(setup.height, setup.rows, row);
  return {x, y, TileBegin(setup.width, setup.columns, column + 1) - x,
          TileBegin(setup.height, setup.rows, row + 1) - y};
}

Rect WithBorder(const SweepSetup& setup, int32_t index) {
  return Widened(setup, TileOf(setup, index), setup.repairs ? kRepairBorder : kTileBorder);
}

}  // namespace starfocus
