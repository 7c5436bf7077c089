// SPDX-License-Identifier: Apache-2.0
// Estimates the detail of the far surface in mixed pixels that no side view shows. For these
// pixels, means of known light (far_light.h) are the only estimate of the far surface's light.
#ifndef STARFOCUS_LIB_MATTING_FAR_DETAIL_H_
#define STARFOCUS_LIB_MATTING_FAR_DETAIL_H_

#include "lib/matting/coverage_input.h"

namespace starfocus {

// Adds detail to the light of the far surface in the mixed pixels of a tile. The light of a mixed
// pixel that the means of both surfaces do not explain is detail of one of the surfaces. The far
// surface gets a part of this light, which decreases with the coverage. Without this part, faint
// coverage would give all detail of the background to the near surface.
void AddFarDetail(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_FAR_DETAIL_H_
