// SPDX-License-Identifier: Apache-2.0
// Removes stray pixels from an estimated map. The colours of the centre view guide the removal.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/setup.h"

namespace starfocus {

// Returns the disparity of pixel (x, y), or the weighted median of its neighbourhood if the pixel's
// disparity differs too much from the median. Neighbours of similar colour have larger weights.
// `map` has the size of the picture, and disparities are in fixed point (kDisparityBits).
int16_t WithoutStray(const EstimatePlan& plan, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
