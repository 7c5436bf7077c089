// SPDX-License-Identifier: Apache-2.0
// The loop over the stripes of a picture (ForStripes), and the refocusing of whole pictures.
#ifndef STARFOCUS_LIB_ENGINE_DRIVER_H_
#define STARFOCUS_LIB_ENGINE_DRIVER_H_

#include <cstdint>

#include "lib/base/config.h"
#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/engine/engine.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct Output;

// Returns the status of flags (simd::kUnknownDepth): STARFOCUS_OK, STARFOCUS_ERROR_NOT_FINITE or
// STARFOCUS_ERROR_DISPARITY. If both kinds of errors occur, returns STARFOCUS_ERROR_NOT_FINITE.
starfocus_status CheckFlags(uint32_t flags, const FullConfig& config);

// If `disparity` is null, checks the map of the engine's input, and returns an error of CheckFlags
// if any value on which `rows` depend is invalid. Otherwise converts rows of the map to `disparity`
// and, if the input converts the centre view, rows of the centre view to their ring.
starfocus_status ReadRows(const Range& rows, const Plane<int16_t>* disparity, EngineState* engine);

// Returns the rows of all stripes that affect the region of the lens. The first row is a multiple
// of the superblock size.
Range StripeRows(const EngineState& engine);

// The loop over stripes of whole pictures, streams and prepared light fields. A stripe reads its
// own rows and `reach` rows above and below. Calls step(y, read) for the stripes that begin at
// stripes.first and every superblock after it, before stripes.last. `read` are the input rows that
// no earlier stripe of the loop has read. Stops before the first stripe that reads a row from
// `available` on, and after the first step that does not return STARFOCUS_OK. Returns the status of
// the last step.
template <class Step>
starfocus_status ForStripes(const Range& stripes, int32_t reach, int32_t available,
                            const FullConfig& config, const Step& step) {
  starfocus_status status = STARFOCUS_OK;
  Range read = {0, Max(0, stripes.first - reach)};
  for (int32_t y = stripes.first; y < stripes.last; y += config.superblock) {
    read = {read.last, Min(config.height, y + config.superblock + reach)};
    if (read.last > available) break;
    status = step(y, read);
    if (status != STARFOCUS_OK) break;
  }
  return status;
}

// Refocuses the stripes that affect the region of the lens, and stores the rows of the region.
// Checks all input rows before it stores the first output row. Returns STARFOCUS_OK,
// STARFOCUS_ERROR_CANCELLED, STARFOCUS_ERROR_RUNNER or an error of the disparity map.
starfocus_status RefocusRows(const Output& out, EngineState* engine);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_DRIVER_H_
