// SPDX-License-Identifier: Apache-2.0
// Loop over the stripes of a picture. Every entry point of the engine except streams runs this loop
// with an input and an output. Streams do not use the loop and refocus one stripe at a time.
#ifndef STARFOCUS_LIB_ENGINE_DRIVER_H_
#define STARFOCUS_LIB_ENGINE_DRIVER_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/engine.h"
#include "lib/io/output.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the status of simd::DepthFlags: STARFOCUS_OK, STARFOCUS_ERROR_NOT_FINITE or
// STARFOCUS_ERROR_DISPARITY. If both kinds of errors occur, returns STARFOCUS_ERROR_NOT_FINITE.
starfocus_status CheckFlags(uint32_t flags, const starfocus_config& config);

// If `disparity` is null, checks the map of the engine's input, and returns an error of CheckFlags
// if any value on which `rows` depend is invalid. Otherwise converts rows of the map to `disparity`
// and, if the input converts the centre view, rows of the centre view to their ring.
starfocus_status ReadRows(const Range& rows, const Plane<int16_t>* disparity, EngineState* engine);

// Returns the rows of all stripes that affect the region of the lens. The first row is a multiple
// of the superblock size.
Range StripeRows(const EngineState& engine);

// Refocuses the stripes that affect the region of the lens, and stores the rows of the region.
// Checks all input rows before it stores the first output row. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_CANCELLED, STARFOCUS_ERROR_RUNNER or an error of the disparity map.
starfocus_status RefocusRows(const Output& out, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_DRIVER_H_
