// SPDX-License-Identifier: Apache-2.0
// Finds the pixels near large depth edges, and the disparities of the two surfaces that meet at
// each edge. The first two coverage passes (passes.h) call the functions of this header.
#ifndef STARFOCUS_LIB_MATTING_BAND_H_
#define STARFOCUS_LIB_MATTING_BAND_H_

#include "lib/matting/coverage_input.h"

namespace starfocus {

// Sets CoverageTile::ragged of the tiles [first, last) of a row: true if enough pixels of the tile
// lie next to depth edges. If the light field provides coverage, a single pixel next to an edge
// makes a tile ragged.
void FindRagged(const CoverageInput& in, int32_t first, int32_t last, int32_t row);

// Initialises a tile as a single surface with the disparities of the disparity map.
void ClearTile(const CoverageInput& in, int32_t column, int32_t row);

// Writes the initial alpha (0, kWhole or kUnparted) and the near disparities of a tile, both from
// the disparity map alone. Reads the light of the far surface from the centre view, and writes this
// light to the cells of the tile at all levels.
void StartTile(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_BAND_H_
