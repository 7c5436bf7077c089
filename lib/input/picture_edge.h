// SPDX-License-Identifier: Apache-2.0
// What lies beyond the picture's edges, where captured views look.
#ifndef STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
#define STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"

namespace starfocus {

// How many pixels of the picture, from its edge on, are looked at for what may cover a pixel beyond
// it: no more than the rows that are kept around a stripe. On scenes whose disparities differ by
// less, fewer give the same pictures (docs/constants.md).
inline constexpr int32_t kLookBack = 32;

// Where a field repeats an edge of the picture, the edge's surface goes on instead: pixels as far
// beyond the edge as its disparity moves it from unit to unit take their colour from the captured
// view that shows them, up to where something nearer covers them there. What lies farther away
// repeats the last of them. Without side views, and beyond corners, nothing changes.
void ExtendEdges(const Window& window, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
