// SPDX-License-Identifier: Apache-2.0
// Previews: an engine is temporarily laid out for the size of a reduced light field.
#ifndef STARFOCUS_LIB_API_PREVIEW_H_
#define STARFOCUS_LIB_API_PREVIEW_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"

namespace starfocus {

// Checks the arguments, refocuses the light field that is reduced by params.preview_shift, and
// writes the picture to `out`. The lens and region of `params` are in pixels of the full size.
starfocus_status RefocusPreview(const starfocus_params& params, const Prepared& prepared,
                                const starfocus_image& out, EngineState* engine,
                                starfocus_report* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREVIEW_H_
