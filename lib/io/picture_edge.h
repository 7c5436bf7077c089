// SPDX-License-Identifier: Apache-2.0
// Extends surfaces beyond the edges of the picture with the content of side views.
#ifndef STARFOCUS_LIB_IO_PICTURE_EDGE_H_
#define STARFOCUS_LIB_IO_PICTURE_EDGE_H_

#include "lib/io/block_pixels.h"
#include "lib/io/window.h"

namespace starfocus {

// Number of pixels inside the picture's edge that are searched for surfaces that may cover a pixel
// outside. The rows stored around a stripe suffice for a search over kLookBack pixels. If
// disparities differ by less than kLookBack, a search over fewer pixels finds all covering surfaces
// (docs/constants.md).
inline constexpr int32_t kLookBack = 32;

// In a field, replaces the repeated edge pixels of the picture by a continuation of the surface at
// the edge. Pixels beyond the edge get their colour from the captured view that shows them. The
// number of pixels that the view shows is the displacement of the edge in that view. The continued
// surface ends earlier if a nearer surface covers the continued surface in the captured view.
// Pixels farther outside repeat the colour of the last continued pixel. Pixels beyond corners, and
// fields of light fields without side views, are not changed.
void ExtendEdges(const Window& window, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_PICTURE_EDGE_H_
