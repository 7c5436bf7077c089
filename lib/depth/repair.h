// SPDX-License-Identifier: Apache-2.0
// Repairs the disparity map of a light field with its side views. It uses the sweeps of an
// estimate, in which a label costs more the farther it is from the map. A last phase decides which
// of the contradicted pixels are changed.
#ifndef STARFOCUS_LIB_DEPTH_REPAIR_H_
#define STARFOCUS_LIB_DEPTH_REPAIR_H_

#include "lib/depth/estimate.h"

namespace starfocus {

// Repairs light_field.depth into `output`; the plan must be one for repairs. Pixels that nothing
// contradicts keep their disparity to the bit. Unknown pixels (NaN, infinite) get one. Returns
// STARFOCUS_OK, STARFOCUS_ERROR_CANCELLED or STARFOCUS_ERROR_RUNNER.
starfocus_status Repair(const EstimatePlan& plan, const starfocus_light_field& light_field,
                        const simd::DepthKernels& kernels, const MapOutput& output,
                        EstimateMemory* memory);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_DEPTH_REPAIR_H_
