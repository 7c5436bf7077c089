// SPDX-License-Identifier: Apache-2.0
// What a tile sees of the views, and which disparities are hidden there.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Makes the planes of all views around `region`, as far as disparities reach.
void LoadPatches(const EstimatePlan& plan, const starfocus_light_field& light_field,
                 const Rect& region, const simd::DepthKernels& kernels, Patches* patches);

// Fills in where the patches show each label in each side view.
void FindMoves(const EstimatePlan& plan, const Patches& patches, simd::ViewMove* moves);

// Where views end, nothing else is known to be hidden: the first estimate.
void MarkOutside(const EstimatePlan& plan, Patches* patches);

// What the pixels of a map (width * height disparities) hide of the views when each of them is
// where its disparity says: wherever pixels of the region can lie.
void MarkHidden(const EstimatePlan& plan, const int16_t* map, const Rect& region, Patches* patches);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PATCH_H_
