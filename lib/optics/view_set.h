// SPDX-License-Identifier: Apache-2.0
// Positions of the captured views, and the choice of views that see behind depth edges.
#ifndef STARFOCUS_LIB_OPTICS_VIEW_SET_H_
#define STARFOCUS_LIB_OPTICS_VIEW_SET_H_

#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/fixed.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Directions from a pixel in which surfaces may be hidden.
inline constexpr int kSideCount = 4;
inline constexpr int8_t kSides[kSideCount][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

// Position (u, v) of a captured view; each coordinate is in [-1, 1], kViewBits.
struct ViewPosition {
  int16_t u, v;
};

// A captured side view; 0 stands for a missing view.
struct OcclusionView {
  int8_t view;
  ViewPosition at;
};

// Largest number of views that the engine reads for each direction.
inline constexpr int kOcclusionViews = 2;

// Views that see behind depth edges in each direction, in the order of kSides, best view first.
struct OcclusionViews {
  OcclusionView on[kSideCount][kOcclusionViews] = {};

  // Returns the last view of `side`, in the order of OcclusionViews. Among views on the axis of the
  // side, the last view is the view that is nearest to the centre.
  const OcclusionView& Last(int side) const {
    return on[side][on[side][kOcclusionViews - 1].view != 0 ? kOcclusionViews - 1 : 0];
  }
};

// Captured views of a configuration.
struct ViewSet {
  int32_t count = 0;
  bool star = false;  // true if the views have the positions that starfocus_view_position returns
  ViewPosition at[STARFOCUS_MAX_VIEWS] = {};
};

// Returns the position of view `index` in the standard layout of 1, 5, 9 or 17 views.
ViewPosition StarPosition(int index);

// Returns the index of the view in direction (u, v) of the standard layout, at full distance or, if
// `half` is true, at half distance. The values u and v are -1, 0 or 1, and not both 0.
int CapturedView(int u, int v, bool half);

// Finds the views of a configuration. If all `positions` (STARFOCUS_MAX_VIEWS elements) are (0, 0),
// the positions are those of starfocus_view_position. Returns STARFOCUS_ERROR_RANGE for an invalid
// number of views or invalid positions. `problem` may be null.
starfocus_status FindViews(int32_t count, const starfocus_position* positions,
                           starfocus_problem* problem, ViewSet* views);

// Returns true if the views of a valid configuration have the positions that
// starfocus_view_position returns.
bool HasStar(const FullConfig& config);

// Returns true if two valid configurations have the same views in the same order.
bool SameViews(const FullConfig& a, const FullConfig& b);

// Chooses the views that see behind edges on each side: the views whose direction is closer to this
// side than to any other side. The farthest views near the axis of the side come first, because the
// area that they see behind an edge is the largest. A side without views in its direction uses
// other views, up to 83 degrees from its axis, which see behind thin or slanted edges. Views at
// larger angles would see next to nothing (docs/constants.md).
OcclusionViews ChooseOcclusionViews(const ViewSet& views);

// Returns a distance between pixels of the centre view, scaled to a view at `position` (kViewBits)
// on an axis. The result is rounded half away from 0.
constexpr int32_t ScaledByView(int32_t position, int32_t distance, int bits) {
  const int64_t product = int64_t{position < 0 ? -position : position} * distance;
  const auto scaled = static_cast<int32_t>(RoundShift(product, bits));
  return position < 0 ? -scaled : scaled;
}

}  // namespace starfocus

#endif  // STARFOCUS_LIB_OPTICS_VIEW_SET_H_
