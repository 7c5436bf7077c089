// SPDX-License-Identifier: Apache-2.0
// Grid of the rendered views of one lens: N, the weights of the views, and the displacement of
// pixels between views.
#ifndef STARFOCUS_LIB_OPTICS_VIEW_GRID_H_
#define STARFOCUS_LIB_OPTICS_VIEW_GRID_H_

#include <cmath>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/optics/view_weights.h"

namespace starfocus {

// Range of disparities in focus. A point is blurred, and moves from view to view, by its distance
// from this range. A lens with a single disparity in focus has far == near.
struct FocusRange {
  int32_t far = 0, near = 0;  // d_t: smallest and largest disparity in focus, kDisparityBits

  // Returns the distance of a disparity from the range: 0 inside the range, negative behind it.
  int32_t Distance(int32_t disparity) const { return disparity - Clamp(disparity, far, near); }

  // Returns the disparity at the same distance from a lens that has only `far` in focus. The order
  // of disparities is kept. If the range is a single disparity, the result is `disparity`.
  int16_t WithoutRange(int16_t disparity) const {
    return static_cast<int16_t>(far + Distance(disparity));
  }

  bool IsSingle() const { return far == near; }
};

// Returns the range from focus - farther to focus + nearer, in pixels per unit of u. Both ends are
// within +-10^6. The far end of a wider range is raised to the smallest possible disparity, so that
// results of WithoutRange fit in 16 bits.
inline FocusRange MakeFocusRange(double focus, double nearer = 0, double farther = 0) {
  const auto rounded = [](double disparity) {
    return static_cast<int32_t>(
        Checked(ranges::kFocus, std::floor(disparity * (1 << kDisparityBits) + 0.5)));
  };
  constexpr auto kSmallest = static_cast<int32_t>(ranges::kDisparity.low);
  const int32_t near = rounded(focus + nearer);
  return {Max(rounded(focus - farther), Min(near, kSmallest)), near};
}

struct ViewGrid {
  ViewWeights aperture;  // N views along the radius.
  FocusRange focus;      // d_t
  int64_t step = 0;      // Position of the view at the rim, in pixels of the layer per unit of
                         // disparity: u_t / 2^layer, kStepBits.
  int layer = 0;         // Layer L.
  double radius = 0;     // Position of the view at the rim, u_t.

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

// Returns the grid for `radius` u_t in (0, 1] and focus d_t.
inline ViewGrid MakeViewGrid(const ViewWeights& aperture, const FocusRange& focus, double radius,
                             int layer) {
  ViewGrid grid;
  grid.aperture = aperture;
  grid.focus = focus;
  const double step = radius * (int64_t{1} << kStepBits);
  grid.step = RoundShift(static_cast<int64_t>(step) << 1, 1 + layer);
  if (grid.step < 1) grid.step = 1;
  grid.layer = layer;
  grid.radius = radius;
  return grid;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_VIEW_GRID_H_
