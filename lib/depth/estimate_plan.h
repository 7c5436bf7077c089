// SPDX-License-Identifier: Apache-2.0
// Parameters of an estimate of disparities: the labels, the views in the order of the kernels, and
// the tiles that jobs process.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "starfocus/depth.h"

namespace starfocus {

// Tiles are half to one and a half times kTileSide wide and high. Pixels up to kTileMargin around a
// tile influence its result; paths that begin farther away hardly matter.
inline constexpr int32_t kTileSide = 256, kMostTileSide = 3 * kTileSide / 2;
inline constexpr int32_t kTileMargin = 32;
// Margin of a repair: the given map makes a smaller margin sufficient.
inline constexpr int32_t kRepairMargin = 12;

inline constexpr int32_t kLabelStep = 1 << (kDisparityBits - 1);  // half a pixel
inline constexpr int32_t kMostLabels = 129;
inline constexpr int32_t kMostSideViews = STARFOCUS_MAX_VIEWS - 1;

// A captured side view, with its position in halves of a unit.
struct SideView {
  int32_t index;
  int32_t u2, v2;
};

struct EstimatePlan {
  int32_t width, height;
  // Disparity of label 0 and between labels, kDisparityBits. The step is a multiple of half a
  // pixel.
  int32_t low, step;
  int32_t labels;
  int32_t reach;  // largest movement of a disparity in pixels, plus one
  // side views: arms in the order of their angles; the outer ring is the first
  int32_t arms, rings;
  SideView side[kMostSideViews];
  int32_t directions;     // number of directions of paths: 4 or 8
  bool repairs;           // true: repairs a given map; false: estimates a new one
  int32_t columns, rows;  // numbers of tiles, both odd: a mirrored picture has mirrored tiles

  int32_t side_views() const { return arms * rings; }
  // Returns the disparity of label l.
  int32_t Disparity(int32_t l) const { return low + l * step; }
  // Returns the number of labels after which the moves of a view repeat the same fraction of a
  // pixel: 1, 2 or 4.
  int32_t Phases(const SideView& view) const;
  // Returns the sum of the phases of all side views.
  int32_t AllPhases() const;
};

EstimatePlan MakePlan(const starfocus_depth_config& config);

// Returns a plan with every second label, none of them beyond the last one, and half of the paths.
// The first sweep of a repair uses it, since that sweep only finds which surfaces hide others.
EstimatePlan CoarsePlan(const EstimatePlan& plan);

// Returns the number of tiles, an odd number, into which `length` pixels are divided. Tiles are
// half to one and a half times `side` long.
int32_t TilesAlong(int32_t length, int32_t side);
// Returns the first pixel of tile k of `count`, which is odd.
int32_t TileBegin(int32_t length, int32_t count, int32_t k);

// Returns the rectangle of tile `index` of columns * rows.
Rect TileOf(const EstimatePlan& plan, int32_t index);
// Returns the region that is swept for a tile: the tile and its margin.
Rect RegionOf(const EstimatePlan& plan, int32_t index);
// Returns the rectangle enlarged by `margin` on all sides and clipped to the picture.
Rect Widened(const EstimatePlan& plan, const Rect& rect, int32_t margin);

// Returns the move of disparity d from the centre view to a side view, in 128ths of a pixel.
inline int32_t MoveAcross(const SideView& view, int32_t d) { return -view.u2 * d; }
inline int32_t MoveDown(const SideView& view, int32_t d) { return -view.v2 * d; }
// Rounds a move to whole pixels. Halves round towards zero, so that mirrored moves stay mirrored.
inline int32_t WholeMove(int32_t move) { return (move + 63 + (move < 0 ? 1 : 0)) >> 7; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
