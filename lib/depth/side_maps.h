// SPDX-License-Identifier: Apache-2.0
// Finds pixels that no side view shows, if all side views lie on one side of the centre view as in
// a stereo pair. The disparity map of each side view is estimated first, with the centre view as
// the only view beside it. A side view shows a pixel if both maps have about the same disparity
// there.
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

// Returns the map of side view k in memory->side_maps.
int16_t* SideMap(const EstimatePlan& plan, const EstimateMemory& memory, int32_t k);

// Copies memory->second to memory->first for the pixels of `tile`. Pixels that no side view shows
// become kNoSurface.
void FindUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory);

// Sets each pixel of `tile` that is kNoSurface in memory->first to the disparity of the background
// beside it: of the nearest known pixels in eight directions, the second smallest disparity. Writes
// the disparities to memory->second and sets the certainty to 0. Pixels without known pixels nearby
// keep their disparity.
void FillUnseen(const EstimatePlan& plan, const Rect& tile, EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SIDE_MAPS_H_
