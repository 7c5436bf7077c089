// SPDX-License-Identifier: Apache-2.0
// Pixels near large depth edges, and the disparities of the two surfaces that meet there.
#ifndef STARFOCUS_LIB_COVERAGE_BAND_H_
#define STARFOCUS_LIB_COVERAGE_BAND_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Marks those of the tiles [first, last) of a row `ragged` in which edges are so many that they may
// be thin structure, or where coverage is given those that have any.
void FindRagged(const CoverageInput& in, int32_t first, int32_t last, int32_t row);

// Makes all of a tile one surface, at the map's disparities.
void ClearTile(const CoverageInput& in, int32_t column, int32_t row);

// Writes the tile's first guess of alpha by the map alone (0, kWhole, kUnparted), its near
// disparities, and its far light by the centre view, at all levels.
void StartTile(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_BAND_H_
