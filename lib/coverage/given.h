// SPDX-License-Identifier: Apache-2.0
// Uses the coverage that a light field provides. It holds detail that the disparity map lacks, so
// surfaces are searched farther from the map's edges than by band.h.
#ifndef STARFOCUS_LIB_COVERAGE_GIVEN_H_
#define STARFOCUS_LIB_COVERAGE_GIVEN_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Writes both surfaces of the tile's pixels near edges, and their given coverage. Sets `mixed` if
// any of them differs from the coverage that the map implies.
void StartGiven(const CoverageInput& in, int32_t column, int32_t row);

// Writes the tile's coverage and its far light, from the far light of all views (look.h).
void TakeGiven(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_GIVEN_H_
