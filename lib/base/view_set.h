// SPDX-License-Identifier: Apache-2.0
// Where the captured views lie, and which of them look round depth edges on each side of a pixel.
#ifndef STARFOCUS_LIB_BASE_VIEW_SET_H_
#define STARFOCUS_LIB_BASE_VIEW_SET_H_

#include <cstdint>

#include "lib/base/fixed.h"
#include "starfocus/starfocus.h"

namespace starfocus {

inline constexpr int kMaxViews = STARFOCUS_MAX_VIEWS;

// The sides of a pixel.
inline constexpr int kSideCount = 4;
inline constexpr int8_t kSides[kSideCount][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// Position of a captured view: (u, v), kViewBits, each in [-1, 1].
struct ViewPosition {
  int16_t u, v;
};

// A captured view beside the centre one; view 0 stands for none.
struct OcclusionView {
  int8_t view;
  ViewPosition at;
};

// How many views are looked into behind an edge, one after the other.
inline constexpr int kOcclusionViews = 2;

// The views that look behind depth edges on each side: as of kSides, the best first.
struct OcclusionViews {
  OcclusionView on[kSideCount][kOcclusionViews] = {};

  // The last view of a side, which is the nearest one where they lie on its axis.
  const OcclusionView& Last(int side) const {
    return on[side][on[side][kOcclusionViews - 1].view != 0 ? kOcclusionViews - 1 : 0];
  }
};

// The captured views of a configuration.
struct ViewSet {
  int32_t count = 0;
  bool star = false;  // whether they are those of starfocus_view_position
  ViewPosition at[kMaxViews] = {};
};

// Position `index` of the star.
ViewPosition StarPosition(int index);

// Index of the star's view in direction (u, v), each -1, 0 or 1 and not both 0, at full or half
// distance.
int CapturedView(int u, int v, bool half);

// Finds the views of a configuration. Refuses views and positions that are none,
// STARFOCUS_ERROR_RANGE.
starfocus_status FindViews(const starfocus_config& config, ViewSet* views);

// Whether the views of a configuration, which was checked, are those of starfocus_view_position.
bool HasStar(const starfocus_config& config);

// Whether two configurations, which were checked, have the same views in the same order.
bool SameViews(const starfocus_config& a, const starfocus_config& b);

// Chooses the views that look behind edges on each side: those that lie nearer to its direction
// than to any other. Of these the farthest out come first, as far as they lie on the side's axis:
// they look behind more. Where there are none, others up to 83 degrees from the axis stand in:
// they look behind what is thin or slanted, and those farther beside it behind next to nothing
// (docs/constants.md).
OcclusionViews ChooseOcclusionViews(const ViewSet& views);

// A distance of the centre view's pixels, kDisparityBits or any other, as a view at `position` of
// one axis shows it; halves away from 0.
constexpr int32_t ScaledByView(int32_t position, int32_t distance, int bits) {
  const int64_t product = int64_t{position < 0 ? -position : position} * distance;
  const auto scaled = static_cast<int32_t>(RoundShift(product, bits));
  return position < 0 ? -scaled : scaled;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_BASE_VIEW_SET_H_
