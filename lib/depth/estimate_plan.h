// SPDX-License-Identifier: Apache-2.0
// Defines the parameters of an estimate of disparities: the labels, the views in the order of the
// SIMD kernels, and the tiles that jobs process.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/geometry.h"
#include "starfocus/depth.h"

namespace starfocus {

// Sides of tiles are between 0.5 and 1.5 times kTileSide. Pixels within kTileMargin of a tile
// influence the tile's result. Paths from pixels farther away have hardly any effect.
inline constexpr int32_t kTileSide = 256, kMostTileSide = 3 * kTileSide / 2;
inline constexpr int32_t kTileMargin = 32;
// Margin of the tiles of a repair. Because of the given map, a smaller margin than kTileMargin is
// sufficient.
inline constexpr int32_t kRepairMargin = 12;

inline constexpr int32_t kLabelStep = 1 << (kDisparityBits - 1);  // half a pixel
inline constexpr int32_t kMostLabels = 129;
inline constexpr int32_t kMostSideViews = STARFOCUS_MAX_VIEWS - 1;

// A captured side view. The members u2 and v2 are twice the coordinates u and v of the view's
// position.
struct SideView {
  int32_t index;
  int32_t u2, v2;
};

struct EstimatePlan {
  int32_t width, height;
  // Disparity of label 0, and difference between the disparities of adjacent labels, in fixed point
  // (kDisparityBits). The difference is a multiple of half a pixel.
  int32_t low, step;
  int32_t labels;
  int32_t reach;  // largest movement, in pixels, of a point from the centre view to a side view,
                  // plus one
  // Side views. The views at full distance from the centre come first, and views at one distance
  // are in the order of their angles.
  int32_t arms, rings;
  SideView side[kMostSideViews];
  int32_t directions;     // Number of directions of paths: 4 or 8.
  bool repairs;           // True to repair a given map, false to estimate a new one.
  int32_t columns, rows;  // Numbers of tiles; odd, so that mirrored pictures have mirrored tiles.

  int32_t side_views() const { return arms * rings; }
  // Returns the disparity of label l.
  int32_t Disparity(int32_t l) const { return low + l * step; }
  // Labels shift a view by fractions of a pixel that repeat periodically. Returns the period in
  // labels: 1, 2 or 4.
  int32_t Phases(const SideView& view) const;
  // Returns the sum of Phases over all side views.
  int32_t AllPhases() const;
};

EstimatePlan MakePlan(const starfocus_depth_config& config);

// Returns a plan with every second label of `plan` and with half of the paths. The last label of
// the coarse plan does not exceed the last label of `plan`. The first sweep of a repair uses the
// coarse plan, because the first sweep only determines which surfaces hide other surfaces.
EstimatePlan CoarsePlan(const EstimatePlan& plan);

// Returns the number of tiles into which `length` pixels are divided. The number is odd, and each
// tile is between 0.5 and 1.5 times `side` long.
int32_t TilesAlong(int32_t length, int32_t side);
// Returns the first pixel of tile k if `length` pixels are divided into `count` tiles. `count` must
// be odd.
int32_t TileBegin(int32_t length, int32_t count, int32_t k);

// Returns the rectangle of tile `index`; `index` is in [0, columns * rows).
Rect TileOf(const EstimatePlan& plan, int32_t index);
// Returns the region that is swept for tile `index`, which is the tile extended by the margin of
// the plan.
Rect RegionOf(const EstimatePlan& plan, int32_t index);
// Returns the rectangle enlarged by `margin` on all sides and clipped to the picture.
Rect Widened(const EstimatePlan& plan, const Rect& rect, int32_t margin);

// Returns the horizontal or vertical movement of a point of disparity d from the centre view to a
// side view, in 1/128 pixel.
inline int32_t MoveAcross(const SideView& view, int32_t d) { return -view.u2 * d; }
inline int32_t MoveDown(const SideView& view, int32_t d) { return -view.v2 * d; }
// Rounds a movement in 1/128 pixel to whole pixels. Halves are rounded towards zero, so that
// mirrored movements stay mirrored.
inline int32_t WholeMove(int32_t move) { return (move + 63 + (move < 0 ? 1 : 0)) >> 7; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PLAN_H_
