// SPDX-License-Identifier: Apache-2.0
// What a given disparity map says of the labels of a tile's pixels, and how far the views gainsay
// it.
#ifndef STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
#define STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_

#include <cstdint>

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Adds to the costs of the pixels of `region` what each label costs by the map: the more, the
// further away the next trusted pixel of that disparity is. `trusted` has the picture's size.
void AddMapPrior(const EstimatePlan& plan, const Rect& region, const int16_t* trusted,
                 const simd::DepthKernels& kernels, TileMemory* tile);

// Fills memory->given_cost and found_cost of the pixels of `tile_rect`: the costs of the given
// disparity and of memory->second, without the prior.
void WeighEvidence(const EstimatePlan& plan, const Rect& region, const Rect& tile_rect,
                   const TileMemory& tile, EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_MAP_PRIOR_H_
