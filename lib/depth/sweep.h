// SPDX-License-Identifier: Apache-2.0
// Sweeps over all labels at the pixels of a tile. A sweep measures how well each label fits the
// views, adds the prior of a given map, sums costs along paths from all directions of the plan, and
// chooses the disparity with the smallest sum for each pixel (semi-global matching).
#ifndef STARFOCUS_LIB_DEPTH_SWEEP_H_
#define STARFOCUS_LIB_DEPTH_SWEEP_H_

#include "lib/depth/maps.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Light field, labels and memory of a sweep.
struct Sweep {
  const EstimatePlan& plan;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  EstimateMemory* memory;
};

// Fills `disparity`, a map of the whole picture, for tile `index` from the views on one side of
// each pixel.
void SweepOneSide(const Sweep& sweep, int32_t index, int32_t worker, int16_t* disparity);
// Fills memory->second, `certainty` unless it is null, and, for a repair, the costs for tile
// `index`. Uses the views that see each pixel according to memory->side_maps if the views lie on
// one side, otherwise according to memory->first.
void SweepAllViews(const Sweep& sweep, int32_t index, int32_t worker, uint8_t* certainty);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEEP_H_
