// SPDX-License-Identifier: Apache-2.0
// Measures how well each candidate disparity (label) fits the views at each pixel of a region.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Selects the views that are assumed to see a pixel.
enum class Seeing {
  kOneSide,  // The views on the side whose views fit the pixel best.
  kAll       // All views except views in which the pixel is known to be hidden.
};

// Fills tile->cost for the pixels of `region`. The caller must have loaded the views around
// `region`, and marked the labels (disparities) that nearer surfaces hide in each view
// (tile_views.h).
void MeasureCosts(const EstimatePlan& plan, const Rect& region, Seeing seeing,
                  const simd::DepthKernels& kernels, TileMemory* tile);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_COST_H_
