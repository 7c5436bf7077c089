// SPDX-License-Identifier: Apache-2.0
// Boundary pixels (lib/input/boundary_pixel.h) of line scans.
#ifndef STARFOCUS_LIB_LINE_SCAN_UNMIX_H_
#define STARFOCUS_LIB_LINE_SCAN_UNMIX_H_

#include "lib/base/view_grid.h"
#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// Takes the nearer surface out of the field's pixels beside it, where that surface is the more
// defocused one and they are sharp: its part of them would stay sharp and outline an object that
// has vanished. What the far surface looks like there is read from the captured view
// beside the centre in which the nearer one has moved out of the way; a pixel that is no mixture of
// the two colours stays as it is. The field is as LoadBlock left it; only what lies beyond the
// picture and its outermost pixels, which splat into no rectangle, are not looked at. Only layer 0
// needs it: what is subsampled is blurred enough.
void UnmixEdges(const simd::Kernels& kernels, const Window& window, const ViewGrid& grid,
                BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_UNMIX_H_
