// SPDX-License-Identifier: Apache-2.0
// Loads the views around a tile, and marks the disparities that are hidden in them.
#ifndef STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
#define STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Makes the planes of all views around `region`, as far as disparities reach.
void LoadTileViews(const EstimatePlan& plan, const starfocus_light_field& light_field,
                   const Rect& region, const simd::DepthKernels& kernels, TileViews* views);

// Fills in where each side view shows each label.
void FindMoves(const EstimatePlan& plan, const TileViews& views, simd::ViewMove* moves);

// Marks only where views end; nothing else is known to be hidden. For the first sweep.
void MarkOutside(const EstimatePlan& plan, TileViews* views);

// Marks where the pixels of a map (width * height disparities) hide labels in the views, for all
// places that pixels of the region can move to.
void MarkHidden(const EstimatePlan& plan, const int16_t* map, const Rect& region, TileViews* views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
