// SPDX-License-Identifier: Apache-2.0
// Grid of the rendered views of one lens: N, the weights of the views, and the displacement of
// pixels between views.
#ifndef STARFOCUS_LIB_OPTICS_VIEW_GRID_H_
#define STARFOCUS_LIB_OPTICS_VIEW_GRID_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/optics/focus_range.h"
#include "lib/optics/view_weights.h"

namespace starfocus {

struct ViewGrid {
  ViewWeights aperture;  // N views along the radius.
  FocusRange focus;      // d_t
  int64_t step = 0;      // Position of the view at the rim, in pixels of the layer per unit of
                         // disparity: u_t / 2^layer, kStepBits.
  int layer = 0;         // Layer L.
  // Views with |i| <= half_views fill holes from the captured views at half distance.
  int32_t half_views = 0;
  int32_t spread = 0;  // largest disparity range of pixels that share one shift, kDisparityBits

  // Index of the outermost view along an axis.
  int32_t n() const { return aperture.last; }

  // Returns the position u of view i in pixels of the layer per unit of disparity, kStepBits; i in
  // [0, N], N > 0.
  int64_t Move(int32_t i) const { return (i * step + n() / 2) / n(); }

  // Returns the displacement, in pixels (kShiftBits), of points with disparity `disparity` in a
  // view at position `move`. The absolute value of the displacement is at most the blur radius.
  int32_t Shift(int64_t move, int32_t disparity) const {
    return static_cast<int32_t>(Checked(
        ranges::kShift,
        RoundShift(move * focus.Distance(disparity), kStepBits + kDisparityBits - kShiftBits)));
  }
};

// Returns the grid for aperture radius u_t in (0, 1] and focus d_t.
ViewGrid MakeViewGrid(const ViewWeights& aperture, const FocusRange& focus, double aperture_radius,
                      int layer, bool has_half_views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_VIEW_GRID_H_
