// SPDX-License-Identifier: Apache-2.0
// Reduces pictures to small maps of their brightness, for readers that compare pictures.
#ifndef STARFOCUS_PLATFORM_READERS_BRIGHTNESS_H_
#define STARFOCUS_PLATFORM_READERS_BRIGHTNESS_H_

#include "platform/image.h"
#include "platform/pfm.h"

namespace starfocus {

// Returns the sum of R, G and B, 0 to 765, averaged over each block of factor * factor pixels. All
// blocks have the same size, because averages over different numbers of pixels would produce
// artificial edges. Columns and rows after the last whole block are omitted. The map is empty if
// the picture is smaller than a block.
FloatMap Brightness(const Image& picture, int factor);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_BRIGHTNESS_H_
