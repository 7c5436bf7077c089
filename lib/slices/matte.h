// SPDX-License-Identifier: Apache-2.0
// Splits mixed pixels of a field into the two surfaces that each pixel mixes: boundary pixels
// (lib/matting/boundary_pixel.h), and the pixels of thin structures in the coverage map of
// lib/matting. The compositor calls FindMatte after FindLayeredDepth.
#ifndef STARFOCUS_LIB_SLICES_MATTE_H_
#define STARFOCUS_LIB_SLICES_MATTE_H_

#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// Splits the mixed pixels on the far side of depth edges. After the split, the nearer surface
// covers its share of the pixel, and the far surface lies behind the nearer surface with its own
// colour.
//
// Pixels outside the picture are not split. A pixel is split only if its two surfaces move by more
// than a pixel relative to each other in some view. The outermost pixels of the field are not
// split, because these pixels do not splat into any rectangle. `surfaces` is the output of
// FindLayeredDepth. If a split pixel would have four surfaces, the farthest surface is dropped.
void FindMatte(const simd::Kernels& kernels, const Input& input, const ViewGrid& grid,
               const BlockPixels& field, LayeredDepth* surfaces);

// Gives each pixel of thin tiles the disparity of the surface that covers most of the pixel. With
// these disparities, hidden surfaces end at the boundary of the thin structure. The caller must
// call this function before FindLayeredDepth.
void TakeThinDisparities(const Input& input, BlockPixels* field);

// Gives each pixel of thin tiles the two surfaces that the coverage map contains for the pixel. The
// surfaces of the coverage map replace the surfaces that FindLayeredDepth and FindMatte found. The
// caller must call this function before InpaintHidden.
void PartThin(const Input& input, const BlockPixels& field, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_MATTE_H_
