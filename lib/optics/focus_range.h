// SPDX-License-Identifier: Apache-2.0
// Range of disparities in focus. A point is blurred, and moves from view to view, by its distance
// from this range. A lens with a single disparity in focus has far == near.
#ifndef STARFOCUS_LIB_OPTICS_FOCUS_RANGE_H_
#define STARFOCUS_LIB_OPTICS_FOCUS_RANGE_H_

#include <cmath>
#include <cstdint>

#include "lib/base/fixed.h"

namespace starfocus {

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

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_FOCUS_RANGE_H_
