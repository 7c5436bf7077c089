// SPDX-License-Identifier: Apache-2.0
// Boundary pixels (lib/input/boundary_pixel.h) of slices.
#ifndef STARFOCUS_LIB_SLICES_MATTE_H_
#define STARFOCUS_LIB_SLICES_MATTE_H_

#include "lib/base/view_grid.h"
#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// Parts what the centre view mixes on the far side of depth edges: there the nearer surface covers
// its share of the pixel, and behind it lies the far one in its own colour. Only where views show
// the two moved against each other by more than a pixel, and neither what lies beyond the picture
// nor the field's outermost pixels, which splat into no rectangle. `surfaces` as FindLayeredDepth
// left them; of four surfaces the farthest is dropped.
void FindMatte(const simd::Kernels& kernels, const Window& window, const ViewGrid& grid,
               const BlockPixels& field, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_MATTE_H_
