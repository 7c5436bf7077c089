// SPDX-License-Identifier: Apache-2.0
// Turns the coverage map of thin structures (lib/matting) into surfaces for slices.
#ifndef STARFOCUS_LIB_SLICES_THIN_H_
#define STARFOCUS_LIB_SLICES_THIN_H_

#include "lib/io/block_pixels.h"
#include "lib/io/window.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// Gives each pixel of thin tiles the disparity of the surface that covers most of the pixel. With
// these disparities, hidden surfaces end at the boundary of the thin structure. The caller must
// call this function before FindLayeredDepth.
void TakeThinDisparities(const Window& window, BlockPixels* field);

// Gives each pixel of thin tiles the two surfaces that the coverage map contains for the pixel. The
// surfaces of the coverage map replace the surfaces that FindLayeredDepth and FindMatte found. The
// caller must call this function before InpaintHidden.
void PartThin(const Window& window, const BlockPixels& field, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_THIN_H_
