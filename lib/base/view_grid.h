// SPDX-License-Identifier: Apache-2.0
// The grid of rendered views of one lens: N, the aperture's weights, and how far a pixel moves from
// view to view.
#ifndef STARFOCUS_LIB_BASE_VIEW_GRID_H_
#define STARFOCUS_LIB_BASE_VIEW_GRID_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/base/view_weights.h"

namespace starfocus {

struct ViewGrid {
  ViewWeights aperture;    // N views along the radius
  int32_t focus = 0;       // d_t, kDisparityBits
  int64_t step = 0;        // u_t / 2^layer, kStepBits
  int layer = 0;           // L
  int32_t half_views = 0;  // views |i| <= half_views take holes from the views at half distance
  int32_t spread = 0;      // disparity range of a run, kDisparityBits

  // Number of the outermost view along an axis.
  int32_t n() const { return aperture.last; }

  // u of view i in pixels of the layer per unit of disparity, kStepBits; i in [0, N], N > 0.
  int64_t Move(int32_t i) const { return (i * step + n() / 2) / n(); }

  // Pixels that disparity d moves by under `move`, kShiftBits. |result| is within the blur radius.
  int32_t Shift(int64_t move, int32_t disparity) const {
    return static_cast<int32_t>(
        Checked(ranges::kShift,
                RoundShift(move * (disparity - focus), kStepBits + kDisparityBits - kShiftBits)));
  }
};

// The grid for aperture radius u_t in (0, 1], focus d_t with |d_t| <= 10^6.
ViewGrid MakeViewGrid(const ViewWeights& aperture, double focus, double aperture_radius, int layer,
                      bool has_half_views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_VIEW_GRID_H_
