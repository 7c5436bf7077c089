// Hole filling: the colours of what the centre view does not see, from the captured views.
#ifndef STARFOCUS_LIB_HOLES_H_
#define STARFOCUS_LIB_HOLES_H_

#include <cstdint>

#include "lib/view_grid.h"
#include "lib/window.h"

namespace starfocus {

// A line in the picture and the captured view its rendered views move towards. Everything is in
// the orientation of the line's field.
struct CapturedLine {
  const Window* window;
  bool transposed;
  int32_t x, y;    // picture position of the line's pixel 0
  int32_t dx, dy;  // from pixel to pixel: (1, 0), (1, 1) or (1, -1)
  int sign;        // of the parallax along (dx, dy): +1 towards positive u
  bool half;       // take the views at half distance
};

// Writes the colours of rendered pixels [begin, end) of a line, 3 bytes each, for a background of
// `disparity` that moves by `shift` (kShiftBits) in the rendered view. The side view is read at the
// index that the disparity implies (IV-A). A diagonal view that was not captured (5 views) is
// interpolated from its horizontal and its vertical neighbour, whichever agrees with the visible
// background `colour`; with the centre view alone the background is extended.
void FillHole(const CapturedLine& line, const ViewGrid& grid, int32_t begin, int32_t end,
              int32_t disparity, int32_t shift, const uint8_t* colour, uint8_t* out);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_HOLES_H_
