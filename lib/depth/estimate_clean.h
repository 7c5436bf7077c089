// SPDX-License-Identifier: Apache-2.0
// Removes single wrong pixels from an estimated map, guided by the colours of the centre view.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/estimate_plan.h"

namespace starfocus {

// Returns the disparity of pixel (x, y), or the median around it if the pixel strays from that.
// Neighbours of similar colour have larger weights. `map` has the picture's size, kDisparityBits.
int16_t WithoutStray(const EstimatePlan& plan, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
