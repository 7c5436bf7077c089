// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a light field using the side views. The repair searches over all
// labels (candidate disparities) like an estimate, with an additional cost for labels that differ
// from the map. A last phase decides which of the contradicted pixels are changed.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_H_

#include "lib/depth/estimate.h"

namespace starfocus {

// Repairs light_field.depth and writes the result to `output`. plan.repairs must be true. Pixels
// whose disparity the views do not contradict keep this disparity exactly. Unknown pixels (NaN or
// infinite) get a disparity. Returns STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or
// STARFOCUS_ERROR_RUNNER.
starfocus_status Repair(const EstimatePlan& plan, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_H_
