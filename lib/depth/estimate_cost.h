// SPDX-License-Identifier: Apache-2.0
// How badly each disparity fits the views at each pixel of a region.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// What the views that see a pixel are taken for.
enum class Seeing {
  kOneSide,  // the views on one side of it, whichever fit best
  kAll       // all but those that the views know not to
};

// Fills tile->cost for the pixels of `region`, around which the views were loaded and marked.
void MeasureCosts(const EstimatePlan& plan, const Rect& region, Seeing seeing,
                  const simd::DepthKernels& kernels, TileMemory* tile);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_
