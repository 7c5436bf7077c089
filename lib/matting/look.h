// SPDX-License-Identifier: Apache-2.0
// Reads the light of the far surface from the centre view and from views that see behind edges. The
// coverage passes (passes.h) call LookBehindTile for each thin tile.
#ifndef STARFOCUS_LIB_MATTING_LOOK_H_
#define STARFOCUS_LIB_MATTING_LOOK_H_

#include "lib/matting/coverage_input.h"

namespace starfocus {

// Reads the light of the far surface at the tile's split pixels from the centre view and from the
// OcclusionViews, and recomputes the cells of all levels. Light from a view gets a smaller weight
// if nearer surfaces cover more of the pixel in that view (FarWeight). CoverageMap::first contains
// the coverage by nearer surfaces.
void LookBehindTile(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_LOOK_H_
