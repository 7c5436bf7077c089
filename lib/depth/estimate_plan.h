// SPDX-License-Identifier: Apache-2.0
// What an estimate of disparities is made of: the labels that are tried, the views in the order in
// which kernels take them, and the tiles that jobs work on.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "starfocus/depth.h"

namespace starfocus {

// Tiles are half to one and a half times this wide and high. What lies around a tile decides on its
// pixels, too: paths that begin further away hardly matter.
inline constexpr int32_t kTileSide = 256, kMostTileSide = 3 * kTileSide / 2;
inline constexpr int32_t kTileMargin = 32;
// What a given map says is enough nearer by.
inline constexpr int32_t kRepairMargin = 12;

inline constexpr int32_t kLabelStep = 1 << (kDisparityBits - 1);  // half a pixel
inline constexpr int32_t kMostLabels = 129;
inline constexpr int32_t kMostSideViews = STARFOCUS_MAX_VIEWS - 1;

// A captured view beside the centre; its position in halves of a unit.
struct SideView {
  int32_t index;
  int32_t u2, v2;
};

struct EstimatePlan {
  int32_t width, height;
  int32_t low, step;  // disparity of label 0 and between labels, kDisparityBits; whole half pixels
  int32_t labels;
  int32_t reach;        // pixels that a disparity moves by at most, and one
  int32_t arms, rings;  // side views: arms in the order of their angles, of the outer ring first
  SideView side[kMostSideViews];
  int32_t directions;     // that paths come from: 4 or 8
  bool repairs;           // a given map instead of making one of nothing
  int32_t columns, rows;  // of tiles, both odd: a mirrored picture has mirrored tiles

  int32_t side_views() const { return arms * rings; }
  // Label l's disparity.
  int32_t Disparity(int32_t l) const { return low + l * step; }
  // The labels after which a view's moves are by the same part of a pixel again: 1, 2 or 4.
  int32_t Phases(const SideView& view) const;
  // Those of all side views.
  int32_t AllPhases() const;
};

EstimatePlan MakePlan(const starfocus_depth_config& config);

// The plan with every other label, none of which is beyond the last one, and half of the paths: the
// first sweep of a repair only finds who hides what.
EstimatePlan CoarsePlan(const EstimatePlan& plan);

// How many tiles, an odd number, `length` pixels are divided into: tiles are half to one and a half
// times `side` long.
int32_t TilesAlong(int32_t length, int32_t side);
// Where tile k of `count` begins; count is odd.
int32_t TileBegin(int32_t length, int32_t count, int32_t k);

// The part of the picture that tile `index` of columns * rows is.
Rect TileOf(const EstimatePlan& plan, int32_t index);
// What is swept for it: the tile and what lies around.
Rect RegionOf(const EstimatePlan& plan, int32_t index);
// The rectangle with `margin` more on all sides, as far as the picture goes.
Rect Widened(const EstimatePlan& plan, const Rect& rect, int32_t margin);

// Where a view shows disparity d, in 128ths of a pixel from the place in the centre view.
inline int32_t MoveAcross(const SideView& view, int32_t d) { return -view.u2 * d; }
inline int32_t MoveDown(const SideView& view, int32_t d) { return -view.v2 * d; }
// The same in whole pixels; halves round towards zero, so that mirrored moves stay mirrored.
inline int32_t WholeMove(int32_t move) { return (move + 63 + (move < 0 ? 1 : 0)) >> 7; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
