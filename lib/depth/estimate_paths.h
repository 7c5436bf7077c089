// SPDX-License-Identifier: Apache-2.0
// Implements semi-global matching. Costs are summed along paths from all directions of the plan,
// and each pixel gets the disparity with the smallest sum.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// A tile of an estimate: the region that consists of the tile and its margin, and the tile's
// memory.
struct EstimateTile {
  const EstimatePlan& plan;
  const Rect& region;
  const simd::DepthKernels& kernels;
  const TileMemory& memory;
};

// Computes memory.sum from memory.cost for the pixels of the region.
void AddAllPaths(const EstimateTile& tile);

// Writes the disparities (kDisparityBits) of the part `tile_rect` of the region, and the certainty
// of these disparities, to maps of the whole picture. `certainty` may be null.
void ChooseDisparities(const EstimateTile& tile, const Rect& tile_rect, int16_t* disparity,
                       uint8_t* certainty);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_
