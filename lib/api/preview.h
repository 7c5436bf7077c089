// SPDX-License-Identifier: Apache-2.0
// Previews: an engine is temporarily laid out for the size of a reduced light field.
#ifndef STARFOCUS_LIB_API_PREVIEW_H_
#define STARFOCUS_LIB_API_PREVIEW_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"

namespace starfocus {

struct PreviewRequest {
  const starfocus_params& params;  // lens and region, in pixels of the full size
  const Prepared& prepared;
  int32_t shift;
};

// Checks a request, refocuses the reduced light field, and writes the picture to `out`.
starfocus_status RefocusPreview(const PreviewRequest& request, const starfocus_image& out,
                                EngineState* engine, starfocus_report* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREVIEW_H_
