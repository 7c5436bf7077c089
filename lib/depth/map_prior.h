// SPDX-License-Identifier: Apache-2.0
// Converts a given disparity map to costs of the labels of a tile's pixels, and measures how
// strongly the views contradict the map.
#ifndef STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
#define STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_

#include <cstdint>

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Adds the cost of each label by the map to the costs of the pixels of `region`. The cost grows
// with the distance to the nearest trusted pixel of that disparity. `trusted` has the picture's
// size.
void AddMapPrior(const EstimatePlan& plan, const Rect& region, const int16_t* trusted,
                 const simd::DepthKernels& kernels, TileMemory* tile);

// Fills memory->given_cost and memory->found_cost for the pixels of `tile_rect`: the costs of the
// given disparity and of memory->second, without the prior.
void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
