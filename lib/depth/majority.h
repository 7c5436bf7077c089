// SPDX-License-Identifier: Apache-2.0
// Which of two surfaces most pixels of a pixel's colour are of around it: so the outlines of a
// repaired map are no more ragged than those of the picture.
#ifndef STARFOCUS_LIB_DEPTH_MAJORITY_H_
#define STARFOCUS_LIB_DEPTH_MAJORITY_H_

#include <cstdint>

#include "lib/depth/colour_map.h"

namespace starfocus {

// Whether all pixels that decide about those of a rectangle are of one surface.
bool IsOneSurface(const ColourMap& map, const Rect& rect);

// Returns the pixel's disparity, or the mean of the other surface's around it if more pixels of its
// colour are of that one.
int16_t MajorityAt(const ColourMap& map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAJORITY_H_
