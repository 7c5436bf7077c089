// SPDX-License-Identifier: Apache-2.0
// Blocks of the paper's renderer whose picture is the centre view's, to the byte.
#ifndef STARFOCUS_LIB_LINE_SCAN_NOTHING_MOVES_H_
#define STARFOCUS_LIB_LINE_SCAN_NOTHING_MOVES_H_

#include "lib/plan/renderer.h"

namespace starfocus {

// Returns true if every view shows every pixel of the job's rectangle in the place that it has in
// the centre view. Always false at layers 1 and 2, which are resampled.
bool NothingMoves(const RenderJob& job);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_LINE_SCAN_NOTHING_MOVES_H_
