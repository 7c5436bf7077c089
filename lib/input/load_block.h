// SPDX-License-Identifier: Apache-2.0
// The way from the window to the field of a block.
#ifndef STARFOCUS_LIB_INPUT_LOAD_BLOCK_H_
#define STARFOCUS_LIB_INPUT_LOAD_BLOCK_H_

#include "lib/base/geometry.h"
#include "lib/input/block_pixels.h"
#include "lib/input/window.h"

namespace starfocus {

// Writes the light of `count` pixels of the centre view, inside the picture, from (x, y) of the
// layer on, or their excess (window.is_excess).
void LoadLight(const Window& window, int32_t x, int32_t y, int32_t count, int16_t* rgb);

// Copies `rect` and its border from the window into field->rgb and ->disparity, which must be set.
// Codes are decoded here: every sample of the centre view, once for all views of the aperture.
// Pixels outside the picture repeat its edge, or show what side views see there (picture_edge.h).
void LoadBlock(const Window& window, const Rect& rect, const Border& border, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_INPUT_LOAD_BLOCK_H_
