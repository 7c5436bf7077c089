// SPDX-License-Identifier: Apache-2.0
// What a tile sees of the views, and which disparities are hidden there.
#ifndef STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
#define STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Makes the planes of all views around `region`, as far as disparities reach.
void LoadTileViews(const EstimatePlan& plan, const starfocus_light_field& light_field,
                   const Rect& region, const simd::DepthKernels& kernels, TileViews* views);

// Fills in where the views show each label in each side view.
void FindMoves(const EstimatePlan& plan, const TileViews& views, simd::ViewMove* moves);

// Where views end, nothing else is known to be hidden: the first estimate.
void MarkOutside(const EstimatePlan& plan, TileViews* views);

// What the pixels of a map (width * height disparities) hide of the views when each of them is
// where its disparity says: wherever pixels of the region can lie.
void MarkHidden(const EstimatePlan& plan, const int16_t* map, const Rect& region, TileViews* views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
