// SPDX-License-Identifier: Apache-2.0
// Pixels of thin structures (lib/coverage) as surfaces of slices.
#ifndef STARFOCUS_LIB_SLICES_THIN_H_
#define STARFOCUS_LIB_SLICES_THIN_H_

#include "lib/input/block_pixels.h"
#include "lib/input/window.h"
#include "lib/slices/layered_depth.h"

namespace starfocus {

// Gives pixels of thin tiles the disparity of the surface that covers most of them, so that hidden
// surfaces end there. Call it before FindLayeredDepth.
void TakeThinDisparities(const Window& window, BlockPixels* field);

// Gives pixels of thin tiles the two surfaces that the coverage map has found there, in place of
// those that FindLayeredDepth and FindMatte left. Call it before InpaintHidden.
void PartThin(const Window& window, const BlockPixels& field, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_THIN_H_
