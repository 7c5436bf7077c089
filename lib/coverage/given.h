// SPDX-License-Identifier: Apache-2.0
// Coverage that the light field has: it tells what the map does not, and so farther from the map's
// edges.
#ifndef STARFOCUS_LIB_COVERAGE_GIVEN_H_
#define STARFOCUS_LIB_COVERAGE_GIVEN_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Writes both surfaces of the pixels of a tile near edges and their given coverage, and marks the
// tile `mixed` if the map says something else of any of them.
void StartGiven(const CoverageInput& in, int32_t column, int32_t row);

// Writes the tile's coverage and its far light, from the far light of all views (look.h).
void TakeGiven(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_GIVEN_H_
