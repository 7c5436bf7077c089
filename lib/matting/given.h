// SPDX-License-Identifier: Apache-2.0
// Uses the coverage that a light field provides. Given coverage contains detail that the disparity
// map lacks. Both surfaces of a pixel are therefore searched farther from the map's edges than in
// band.h.
#ifndef STARFOCUS_LIB_MATTING_GIVEN_H_
#define STARFOCUS_LIB_MATTING_GIVEN_H_

#include "lib/matting/coverage_input.h"

namespace starfocus {

// For each pixel of the tile near an edge, writes the disparities of both surfaces, the given
// coverage, and the light of the centre view as light of the far surface. Sets `mixed` if the given
// coverage of any pixel differs from the coverage that the disparity map implies.
void StartGiven(const CoverageInput& in, int32_t column, int32_t row);

// Writes the final coverage of a tile, and the light of the far surface in the tile. LookBehindTile
// (look.h) must have read the light of the far surface, unless the light field has only one view.
void TakeGiven(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_GIVEN_H_
