// SPDX-License-Identifier: Apache-2.0
#include "lib/depth/estimate_cost.h"

#include "lib/base/fixed.h"

namespace starfocus {
namespace {

// A view shows a pixel when nothing there is nearer than this beyond it, kDisparityBits: estimates
// of one surface differ by less.
constexpr int32_t kSurfaceDepth = 1 << kDisparityBits;

// A row of pixels that is measured.
struct CostRow {
  const EstimatePlan& plan;
  const simd::DepthKernels& kernels;
  const TileMemory& tile;
  int32_t x, y;
  size_t count;
};

void MatchSide(const CostRow& row, int32_t view, int32_t d, uint8_t* difference) {
  const Patches& patches = row.tile.patches;
  const SideView& side = row.plan.side[view];
  const int32_t across = MoveAcross(side, d), down = MoveDown(side, d);
  const size_t at = patches.At(row.x + (across >> 7), row.y + (down >> 7));
  simd::MatchRow match = {};
  match.view_stride = patches.stride;
  match.across = across & 127;
  match.down = down & 127;
  for (int32_t c = 0; c < 3; ++c) {
    match.view[c] = patches.Plane(view + 1, c) + at;
    match.centre[c] = patches.Plane(0, c) + patches.At(row.x, row.y);
  }
  row.kernels.MatchView(match, row.count, difference);
}

// Where view `view` shows the row at disparity d: the highest disparities there.
const int16_t* HighestAt(const CostRow& row, int32_t view, int32_t d) {
  const Patches& patches = row.tile.patches;
  const SideView& side = row.plan.side[view];
  return patches.highest + static_cast<size_t>(view) * patches.plane +
         patches.At(row.x + WholeMove(MoveAcross(side, d)), row.y + WholeMove(MoveDown(side, d)));
}

// Keeps what views that don't see the row's pixels at disparity d show there out of the
// differences. A view that ends before is stood in for by the one opposite. So is one that
// something nearer hides, in an estimate; a repair, whose map may have that wrong, only limits it.
void LeaveOutHidden(const CostRow& row, Seeing seeing, int32_t d) {
  const EstimatePlan& plan = row.plan;
  const int16_t* highest[kMostSideViews];
  uint8_t* differences[kMostSideViews];
  for (int32_t view = 0; view < plan.side_views(); ++view) {
    highest[view] = HighestAt(row, view, d);
    differences[view] = row.tile.differences + static_cast<size_t>(view) * row.tile.row_stride;
  }
  const bool limits = plan.repairs && seeing == Seeing::kAll;
  const auto hidden = static_cast<int16_t>(d + kSurfaceDepth);
  const int16_t limit = limits ? int16_t{INT16_MAX - 1} : hidden;
  const int32_t half = plan.arms / 2;
  for (int32_t view = 0; view < plan.side_views(); ++view) {
    if (view % plan.arms >= half) continue;
    row.kernels.StandIn(highest[view], highest[view + half], limit, row.count, differences[view],
                        differences[view + half]);
  }
  if (!limits) return;
  row.kernels.LimitHidden(highest, hidden, static_cast<size_t>(plan.side_views()), row.count,
                          differences);
}

// Measures what disparity d costs at each pixel of the row.
void MeasureLabel(const CostRow& row, Seeing seeing, int32_t d, uint8_t* cost) {
  const EstimatePlan& plan = row.plan;
  const uint8_t* differences[kMostSideViews];
  for (int32_t view = 0; view < plan.side_views(); ++view) {
    uint8_t* difference = row.tile.differences + static_cast<size_t>(view) * row.tile.row_stride;
    MatchSide(row, view, d, difference);
    differences[view] = difference;
  }
  if (!row.tile.patches.all_seen) LeaveOutHidden(row, seeing, d);
  const auto arms = static_cast<size_t>(plan.arms), rings = static_cast<size_t>(plan.rings);
  if (seeing == Seeing::kOneSide) {
    row.kernels.LeastSide(differences, arms, rings, row.count, cost);
  } else {
    row.kernels.MeanCost(differences, arms * rings, row.count, cost);
  }
}

}  // namespace

void MeasureCosts(const EstimatePlan& plan, const Rect& region, Seeing seeing,
                  const simd::DepthKernels& kernels, TileMemory* tile) {
  const size_t places = simd::PathLabels(static_cast<size_t>(plan.labels));
  const auto count = static_cast<size_t>(region.width);
  constexpr auto kGroup = static_cast<int32_t>(simd::kSliceLanes);
  for (int32_t y = region.y; y < region.y + region.height; ++y) {
    const CostRow row = {plan, kernels, *tile, region.x, y, count};
    uint8_t* cost = tile->cost + static_cast<size_t>(y - region.y) * count * places;
    for (int32_t group = 0; group < plan.labels; group += kGroup) {
      const int32_t labels = Min(kGroup, plan.labels - group);
      for (int32_t l = 0; l < labels; ++l) {
        MeasureLabel(row, seeing, plan.Disparity(group + l),
                     tile->label_rows + static_cast<size_t>(l) * tile->row_stride);
      }
      kernels.GatherLabels(tile->label_rows, tile->row_stride, count, cost + group, places);
    }
  }
}

}  // namespace starfocus
