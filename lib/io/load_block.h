// SPDX-License-Identifier: Apache-2.0
// Copies pixels from a window to the field of a block.
#ifndef STARFOCUS_LIB_IO_LOAD_BLOCK_H_
#define STARFOCUS_LIB_IO_LOAD_BLOCK_H_

#include "lib/base/geometry.h"
#include "lib/io/block_pixels.h"
#include "lib/io/window.h"

namespace starfocus {

// Writes the light of `count` pixels of the centre view, or the excess of these pixels if
// window.is_excess. The pixels start at (x, y) of the layer and must be inside the picture.
void LoadLight(const Window& window, int32_t x, int32_t y, int32_t count, int16_t* rgb);

// Copies `rect` and its border from the window to field->rgb and field->disparity, which must be
// set. Each sample of the centre view is decoded once for all views of the aperture. Pixels outside
// the picture repeat its edge, or contain the content of side views (picture_edge.h).
void LoadBlock(const Window& window, const Rect& rect, const Border& border, BlockPixels* field);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_IO_LOAD_BLOCK_H_
