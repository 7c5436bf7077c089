// SPDX-License-Identifier: Apache-2.0
// The far surface's light as all views show it.
#ifndef STARFOCUS_LIB_COVERAGE_LOOK_H_
#define STARFOCUS_LIB_COVERAGE_LOOK_H_

#include "lib/coverage/coverage_input.h"

namespace starfocus {

// Reads the far light of the tile's parted pixels from the centre view and those beside it, each by
// how little covers it there after the first pass, and makes the cells of all levels anew.
void LookBehindTile(const CoverageInput& in, int32_t column, int32_t row);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_LOOK_H_
