// SPDX-License-Identifier: Apache-2.0
// Previews: an engine that for the time of a call is one of a reduced light field's size.
#ifndef STARFOCUS_LIB_API_PREVIEW_H_
#define STARFOCUS_LIB_API_PREVIEW_H_

#include "lib/engine/driver.h"
#include "lib/engine/engine.h"
#include "lib/source/prepared.h"

namespace starfocus {

struct PreviewRequest {
  const sf_params& params;  // in pixels of the full size
  const Prepared& prepared;
  int32_t shift;
};

// Checks all but the output.
sf_status CheckPreview(const PreviewRequest& request, const EngineState& engine);

// The rectangle of the preview that is asked for.
Rect PreviewRect(const PreviewRequest& request, const EngineState& engine);

// Refocuses what CheckPreview has passed into `sink`.
sf_status RefocusPreview(const PreviewRequest& request, const RowSink& sink, EngineState* engine,
                         sf_report* report);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_PREVIEW_H_
