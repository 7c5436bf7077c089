// SPDX-License-Identifier: Apache-2.0
// Extends surfaces beyond the edges of the picture with the content of side views.
#ifndef STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
#define STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"

namespace starfocus {

// Number of pixels inside the edge that are searched for surfaces that may cover a pixel outside.
// The rows stored around a stripe are enough for this distance. If disparities differ by less than
// kLookBack, fewer pixels give the same result (docs/constants.md).
inline constexpr int32_t kLookBack = 32;

// Replaces repeated edges of the picture in a field by the continued surface. Pixels beyond the
// edge get their colour from the captured view that shows them. The number of pixels that the view
// shows is the displacement of the edge in that view. The surface ends earlier where a nearer
// surface covers it in that view. Pixels farther outside repeat the last colour. Pixels beyond
// corners, and fields of light fields without side views, are not changed.
void ExtendEdges(const Window& window, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_PICTURE_EDGE_H_
