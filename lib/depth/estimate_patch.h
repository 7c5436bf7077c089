// SPDX-License-Identifier: Apache-2.0
// What a tile sees of the views, and which disparities are hidden there.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_

#include "lib/depth/estimate_memory.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Copies all views around `region`, as far as disparities reach.
void LoadPatches(const EstimatePlan& plan, const sf_light_field& light_field, const Rect& region,
                 Patches* patches);

// Where views end, nothing else is known to be hidden: the first estimate.
void MarkOutside(const EstimatePlan& plan, Patches* patches);

// What the pixels of a map (width * height disparities) hide of the views when each of them is
// where its disparity says.
void MarkHidden(const EstimatePlan& plan, const int16_t* map, Patches* patches);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_
