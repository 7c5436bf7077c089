// SPDX-License-Identifier: Apache-2.0
// Finds pixels that no side view shows, for sets of views in which all side views lie on one side
// of the centre view, such as a stereo pair. The disparity map of each side view must be estimated
// first, with the centre view as the only side view of this estimate. A side view shows a pixel if
// the maps of the side view and of the centre view have about the same disparity at the pixel.
#ifndef STARFOCUS_LIB_DEPTH_SIDE_MAPS_H_
#define STARFOCUS_LIB_DEPTH_SIDE_MAPS_H_

#include "lib/depth/estimate_memory.h"

namespace starfocus {

// A side view as the reference of an estimate. The only side view of `plan` is the centre view.
struct SideReference {
  EstimatePlan plan;
  starfocus_light_field light_field;
};

// Returns side view k of the plan as the reference of an estimate.
SideReference MakeSideReference(const EstimatePlan& plan, const starfocus_light_field& light_field,
                                int32_t k);

// Copies memory->second to memory->first for the pixels of `tile`. Pixels that no side view shows
// are set to kNoSurface.
void FindUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory);

// Sets each pixel of `tile` that is kNoSurface in memory->first to the disparity of the adjacent
// background, which is the second smallest disparity of the nearest known pixels in eight
// directions. Writes the disparities to memory->second and sets the certainty to 0. Pixels without
// known pixels nearby keep their disparity.
void FillUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SIDE_MAPS_H_
