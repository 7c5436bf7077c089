// SPDX-License-Identifier: Apache-2.0
// Semi-global matching: costs are added up along paths from all directions of a plan, and the
// disparity of each pixel is that of the least sum.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// A tile of an estimate: its pixels with those around it, and its memory.
struct EstimateTile {
  const EstimatePlan& plan;
  const Rect& region;
  const simd::DepthKernels& kernels;
  const TileMemory& memory;
};

// Fills the memory's sums from its costs, for the pixels of the region.
void AddAllPaths(const EstimateTile& tile);

// Writes the disparities, kDisparityBits, of the part of the region that is `tile_rect`, and how
// sure they are, to maps of the whole picture. certainty may be null.
void ChooseDisparities(const EstimateTile& tile, const Rect& tile_rect, int16_t* disparity,
                       uint8_t* certainty);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_PATHS_H_
