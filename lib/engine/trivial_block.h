// SPDX-License-Identifier: Apache-2.0
// Blocks whose picture is known without rendering their views, for the same bytes.
#ifndef STARFOCUS_LIB_ENGINE_TRIVIAL_BLOCK_H_
#define STARFOCUS_LIB_ENGINE_TRIVIAL_BLOCK_H_

#include <cstdint>

#include "lib/input/render_job.h"

namespace starfocus {

// Whether every view shows every pixel of the job's rectangle where the centre view does, so that
// the rectangle is that of the centre view. Only at layer 0: others are resampled all the same.
bool NothingMoves(const RenderJob& job);

// Whether all that may splat into the job's rectangle has one colour, and no side view can show
// another in a hole; colour[3] receives its codes.
bool IsOneColour(const RenderJob& job, uint8_t* colour);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_TRIVIAL_BLOCK_H_
