// SPDX-License-Identifier: Apache-2.0
// Estimates the share of each pixel near an edge that the nearer surface covers.
#ifndef STARFOCUS_LIB_COVERAGE_UNMIX_H_
#define STARFOCUS_LIB_COVERAGE_UNMIX_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Writes the tile's coverage of the first pass, starting from its initial alpha. Sets `mixed` if
// the mean of its pixels is as mixed as in thin structures.
void UnmixFirst(const CoverageInput& in, int32_t column, int32_t row);

// Writes the tile's coverage of the second pass and its far light, from the first pass and the far
// light of all views (look.h).
void UnmixAgain(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_UNMIX_H_
