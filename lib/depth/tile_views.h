// SPDX-License-Identifier: Apache-2.0
// Loads the views around a tile, and marks the labels that are hidden in each view.
#ifndef STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
#define STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_

#include "lib/depth/maps.h"
#include "simd/depth_kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A surface hides a pixel of a view if the surface is nearer by more than kSurfaceDepth
// (kDisparityBits). Estimated disparities of one surface differ by less than kSurfaceDepth.
inline constexpr int32_t kSurfaceDepth = 1 << kDisparityBits;

// Makes the planes of all views. The planes cover `region` and the pixels around it to which labels
// can move pixels of the region.
void LoadTileViews(const EstimatePlan& plan, const starfocus_light_field& light_field,
                   const Rect& region, const simd::DepthKernels& kernels, TileViews* views);

// Computes, for each label and each side view, the movement of a pixel as an offset in the planes.
void FindMoves(const EstimatePlan& plan, const TileViews& views, simd::ViewMove* moves);

// Sets views->hidden to simd::kViewEnds outside the picture, and to 0 (no hidden labels) inside.
// The first sweep uses MarkOutside.
void MarkOutside(const EstimatePlan& plan, TileViews* views);

// Marks the labels that the surfaces in the maps of the side views (SideMap) hide.
void MarkHiddenInMaps(const EstimatePlan& plan, const EstimateMemory& memory, TileViews* views);

// Marks the labels that the pixels of a map hide in the views, at all positions to which pixels of
// the region can move. `map` has width * height disparities.
void MarkHidden(const EstimatePlan& plan, const int16_t* map, const Rect& region, TileViews* views);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_TILE_VIEWS_H_
