// SPDX-License-Identifier: Apache-2.0
// Estimates the coverage of each pixel near an edge: the part of the pixel that the nearer surface
// covers.
#ifndef STARFOCUS_LIB_MATTING_UNMIX_H_
#define STARFOCUS_LIB_MATTING_UNMIX_H_

#include "lib/matting/coverage_input.h"

namespace starfocus {

// Writes the coverage of a tile after the first pass, starting from the tile's initial alpha. Sets
// CoverageTile::mixed if the pixels of the tile are, on average, mixed enough for a thin structure.
void UnmixFirst(const CoverageInput& in, int32_t column, int32_t row);

// Writes the coverage of a tile after the second pass, and the light of the far surface in the
// tile. The inputs are the coverage of the first pass and the light of the far surface that
// LookBehindTile has read (look.h).
void UnmixAgain(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_UNMIX_H_
