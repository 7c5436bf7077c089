// SPDX-License-Identifier: Apache-2.0
// Fills holes: reads colours that the centre view does not show from the captured side views.
#ifndef STARFOCUS_LIB_LINE_SCAN_HOLES_H_
#define STARFOCUS_LIB_LINE_SCAN_HOLES_H_

#include <cstdint>

#include "lib/io/window.h"
#include "lib/line_scan/line_scan.h"
#include "lib/optics/view_grid.h"

namespace starfocus {

// Position of a rendered view, and the captured view (u, v) that fills the holes of the rendered
// view. The coordinates u and v are -1, 0 or 1. Their unit is the distance of the outermost views
// from the centre, or half of this distance if `half` is true. All fields are in the orientation of
// the view's lines.
struct HoleView {
  const Window* window;
  const ViewGrid* grid;
  bool transposed;
  int u, v;
  // ViewGrid::Move of the rendered view's distance along each axis. `move_u` is 0 if u is 0, and
  // `move_v` is 0 if v is 0.
  int64_t move_u, move_v;
  bool half;
};

// A line of the rendered view: position of pixel 0 of the line in the picture, and distance between
// neighbouring pixels.
struct HoleLine {
  int32_t x, y, dx, dy;
};

// Writes the colours (3 samples each) of the rendered pixels [part.begin, part.end) of a line. The
// pixels show a background of disparity `disparity`. The captured view is read at the position that
// the disparity implies (IV-A). If the light field has 5 views, a diagonal view is interpolated
// from its horizontal and its vertical neighbour. Each neighbour is weighted by its similarity to
// the visible background `colour`. With only the centre view, the background colour is repeated.
void FillHole(const HoleView& view, const HoleLine& line, const LinePart& part, int32_t disparity,
              const int16_t* colour, int16_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_HOLES_H_
