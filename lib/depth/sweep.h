// SPDX-License-Identifier: Apache-2.0
// Sweeps over all labels at the pixels of a tile. A sweep measures how well each label fits the
// views, adds the prior of a given map, sums costs along paths from all directions of the plan, and
// chooses the disparity with the smallest sum for each pixel (semi-global matching).
#ifndef STARFOCUS_LIB_DEPTH_SWEEP_H_
#define STARFOCUS_LIB_DEPTH_SWEEP_H_

#include "lib/depth/maps.h"
#include "simd/depth_kernels.h"

namespace starfocus {

struct Sweep {
  const EstimatePlan& plan;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  EstimateMemory* memory;
  int16_t* one_side;  // map of the whole picture that SweepOneSide fills
  bool rates;         // true if SweepAllViews computes the certainty
};

// Fills sweep.one_side for tile `index` from the views on one side of each pixel. SweepOneSide is a
// JobFunction; `data` is a Sweep.
void SweepOneSide(const void* data, int32_t index, int32_t worker);
// Fills memory->second, the certainty and, for a repair, the costs for tile `index`. Uses the views
// that see each pixel according to memory->side_maps if the views lie on one side, otherwise
// according to memory->first. SweepAllViews is a JobFunction; `data` is a Sweep.
void SweepAllViews(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEEP_H_
