// SPDX-License-Identifier: Apache-2.0
// Takes single wrong pixels out of an estimated map, by the colours of the centre view.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/depth/estimate_plan.h"

namespace starfocus {

// Returns the disparity of pixel (x, y), or, where it strays from it, the median of those around
// it, of which the ones of like colour count more. `map` has the picture's size, kDisparityBits.
int16_t WithoutStray(const EstimatePlan& plan, const Plane<const uint8_t>& centre,
                     const int16_t* map, int32_t x, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_CLEAN_H_
