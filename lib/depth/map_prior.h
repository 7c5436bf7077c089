// SPDX-License-Identifier: Apache-2.0
// Converts a given disparity map to label costs for the pixels of a tile, and measures how strongly
// the views contradict the map.
#ifndef STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
#define STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_

#include <cstdint>

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Adds a prior cost to the cost of each label at the pixels of `region`. The prior cost of a label
// increases with the distance to the nearest trusted pixel with the label's disparity. `trusted`
// has the size of the picture.
void AddMapPrior(const EstimatePlan& plan, const Rect& region, const int16_t* trusted,
                 const simd::DepthKernels& kernels, TileMemory* tile);

// Fills memory->given_cost with the cost of the given disparity, and memory->found_cost with the
// cost of memory->second, for the pixels of `tile_rect`. The written costs exclude the prior costs
// of AddMapPrior.
void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
