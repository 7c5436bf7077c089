// SPDX-License-Identifier: Apache-2.0
// Splits the boundary pixels of a field (lib/input/boundary_pixel.h) into their surfaces. Runs
// after FindLayeredDepth.
#ifndef STARFOCUS_LIB_SLICES_MATTE_H_
#define STARFOCUS_LIB_SLICES_MATTE_H_

#include "lib/base/view_grid.h"
#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// Splits the mixed pixels on the far side of depth edges. The nearer surface then covers its share
// of such a pixel, and the far surface lies behind it in its own colour.
//
// Only pixels of the picture are split where views show both surfaces moved against each other by
// more than a pixel. The outermost pixels of the field are not split, since they splat into no
// rectangle. `surfaces` is the output of FindLayeredDepth; if a pixel would have four surfaces, the
// farthest is dropped.
void FindMatte(const simd::Kernels& kernels, const Window& window, const ViewGrid& grid,
               const BlockPixels& field, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_MATTE_H_
