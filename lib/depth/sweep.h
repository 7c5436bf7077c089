// SPDX-License-Identifier: Apache-2.0
// A sweep over all labels of a tile: costs, what a given map says of them, paths, and the choice.
#ifndef STARFOCUS_LIB_DEPTH_SWEEP_H_
#define STARFOCUS_LIB_DEPTH_SWEEP_H_

#include "lib/depth/estimate_memory.h"
#include "simd/depth_kernels.h"

namespace starfocus {

struct Sweep {
  const EstimatePlan& plan;
  const starfocus_light_field& light_field;
  const simd::DepthKernels& kernels;
  EstimateMemory* memory;
  bool rates;  // whether anybody asks for certainty
};

// Fills memory->first of tile `index`, by the views on one side of each pixel. A JobFunction, whose
// data are a Sweep.
void SweepOneSide(const void* data, int32_t index, int32_t worker);
// Fills memory->second, certainty and, of a map that is repaired, costs: by the views that see
// each pixel when the first map is right. A JobFunction, too.
void SweepAllViews(const void* data, int32_t index, int32_t worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_SWEEP_H_
