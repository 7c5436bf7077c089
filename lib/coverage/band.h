// SPDX-License-Identifier: Apache-2.0
// Finds the pixels near large depth edges, and the disparities of the two surfaces that meet there.
// The first passes of lib/coverage (passes.h) call these functions.
#ifndef STARFOCUS_LIB_COVERAGE_BAND_H_
#define STARFOCUS_LIB_COVERAGE_BAND_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Sets `ragged` of the tiles [first, last) of a row: true if a tile has enough edges for thin
// structure. If coverage is given, one edge is enough.
void FindRagged(const CoverageInput& in, int32_t first, int32_t last, int32_t row);

// Makes a tile a single surface with the disparities of the map.
void ClearTile(const CoverageInput& in, int32_t column, int32_t row);

// Writes the tile's initial alpha (0, kWhole or kUnparted) and its near disparities, both from the
// disparity map alone. Also writes the far light that the centre view shows, at all levels.
void StartTile(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_BAND_H_
