// SPDX-License-Identifier: Apache-2.0
// Separates boundary pixels (lib/matting/mixed_pixels.h) for line scans.
#ifndef STARFOCUS_LIB_LINE_SCAN_UNMIX_H_
#define STARFOCUS_LIB_LINE_SCAN_UNMIX_H_

#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

// Removes the nearer surface from adjacent pixels of a sharp farther surface, if the nearer surface
// is more defocused. Without this removal, the nearer surface's part of mixed pixels would remain
// sharp, and would outline an object that the blur has dissolved. The colour of the far surface
// comes from a captured side view in which the nearer surface does not cover the far surface.
// Pixels that are not mixtures of both colours are not changed.
//
// The field must come from LoadBlock. Pixels outside the picture and the outermost pixels, which do
// not splat into the rectangle, are not changed. Only layer 0 requires UnmixEdges, because
// subsampled layers are sufficiently blurred.
void UnmixEdges(const simd::Kernels& kernels, const Input& input, const ViewGrid& grid,
                BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_UNMIX_H_
