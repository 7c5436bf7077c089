// SPDX-License-Identifier: Apache-2.0
// Hole filling: the colours of what the centre view does not see, from the captured views.
#ifndef STARFOCUS_LIB_LINE_SCAN_HOLES_H_
#define STARFOCUS_LIB_LINE_SCAN_HOLES_H_

#include <cstdint>

#include "lib/base/view_grid.h"
#include "lib/input/window.h"
#include "lib/line_scan/line_scan.h"

namespace starfocus {

// Where a rendered view lies, and which captured view it is filled from: the one at (u, v), each
// -1, 0 or 1, at full or half distance. Everything is in the orientation of the view's lines.
struct HoleView {
  const Window* window;
  const ViewGrid* grid;
  bool transposed;
  int u, v;
  int64_t move_u, move_v;  // ViewGrid::Move of |u| and |v| of the rendered view; 0 where u, v are
  bool half;
};

// A line of that view: picture position of its pixel 0 and the step from pixel to pixel.
struct HoleLine {
  int32_t x, y, dx, dy;
};

// Writes the colours of the rendered pixels `part` of a line, 3 samples each, where a background of
// `disparity` shows. The captured view is read at the index that the disparity implies (IV-A). A
// diagonal view that was not captured (5 views) is interpolated from its horizontal and its
// vertical neighbour, by how well each agrees with the visible background `colour`; with the centre
// view alone the background is extended.
void FillHole(const HoleView& view, const HoleLine& line, const LinePart& part, int32_t disparity,
              const int16_t* colour, int16_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_HOLES_H_
