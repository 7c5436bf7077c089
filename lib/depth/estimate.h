// SPDX-License-Identifier: Apache-2.0
// Estimates the disparities of a light field's centre view with two sweeps over all candidate
// disparities (labels). The first sweep uses the views on one side of each pixel. The result of the
// first sweep shows which views see each pixel, and the second sweep uses only these views.
#ifndef STARFOCUS_LIB_DEPTH_ESTIMATE_H_
#define STARFOCUS_LIB_DEPTH_ESTIMATE_H_

#include "lib/depth/estimate_memory.h"
#include "lib/depth/map_rows.h"
#include "simd/depth_kernels.h"

namespace starfocus {

// Estimates the disparity map of the centre view and writes the map to `output`. Returns
// STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status Estimate(const EstimatePlan& plan, const starfocus_light_field& light_field,
                          const simd::DepthKernels& kernels, const MapOutput& output,
                          EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_ESTIMATE_H_
