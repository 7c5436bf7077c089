// SPDX-License-Identifier: Apache-2.0
// Extends surfaces beyond the edges of the picture with the content of side views.
#ifndef STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
#define STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"

namespace starfocus {

// Number of pixels inside the edge that are searched for surfaces that may cover a pixel outside.
// At most as many rows are stored around a stripe. If disparities differ by less, fewer pixels give
// the same result (docs/constants.md).
inline constexpr int32_t kLookBack = 32;

// Replaces repeated edges of the picture in a field by the continued surface. Pixels get their
// colour from the captured view that shows them. That view shows as many pixels beyond the edge as
// the disparity of the edge moves it. The surface ends earlier where a nearer one covers it in that
// view. Pixels farther outside repeat the last one. Without side views and beyond corners, nothing
// changes.
void ExtendEdges(const Window& window, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
