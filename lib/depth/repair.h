// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a light field by its side views: the sweeps of an estimate, in which
// a label costs more the further away the map has it, and then a choice of what was gainsaid.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_H_

#include "lib/depth/estimate.h"

namespace starfocus {

// Repairs light_field.depth into `output`; the plan is one that repairs. Pixels that nothing
// gainsays keep their disparity to the bit, unknown ones (NaN, infinite) get one. STARFOCUS_OK, or
// STARFOCUS_ERROR_RUNNER.
starfocus_status Repair(const EstimatePlan& plan, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_H_
