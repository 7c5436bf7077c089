// SPDX-License-Identifier: Apache-2.0
// Draws the intermediate data of the engine, for the figures of docs/method.md. The engine
// refocuses a light field with the default renderer, and this module draws each block of the
// engine's plan.
#ifndef STARFOCUS_EXAMPLES_LAB_STEPS_STEP_PICTURES_H_
#define STARFOCUS_EXAMPLES_LAB_STEPS_STEP_PICTURES_H_

#include <string>

#include "lib/engine/engine.h"
#include "platform/image.h"
#include "platform/light_field.h"
#include "platform/result.h"

namespace starfocus {

// Focus d_t and aperture radius u_t in (0, 1] of the lens.
struct StepLens {
  double focus = 0, aperture = 1;
};

// Pictures of the size of the light field.
struct StepPictures {
  Image mean;      // Mean of the captured views, shifted to the focus; independent of the aperture.
  Image slices;    // The centre view in grey, tinted by the slice of each pixel's nearest surface.
  Image hidden;    // The first hidden surface; elsewhere the centre view in grey.
  Image matte;     // Share of the nearer surface in mixed pixels; elsewhere the dimmed centre view.
  Image coverage;  // Coverage in thin structures (white is 1); elsewhere the dimmed centre view.
  Image view;      // The view from the rightmost point of the lens, shifted to the focus.
  Image holes;     // `view`, rendered from captured views whose pixels are all magenta.
  Image gathered;  // The refocused picture, tinted violet where the blur is computed by filtering.
};

// Draws all pictures. Errors start with `where`, the name of the light field.
Result<StepPictures> DrawSteps(const std::string& where, const LightField& light_field,
                               const StepLens& lens);

// Draws the surfaces, slices and views of one block. DrawSteps calls these functions while the
// engine plans a stripe.

// A block of the current stripe of an engine, and the light field that the engine refocuses.
struct PlannedBlock {
  const EngineState& engine;
  const Block& block;
  const LightField& light_field;
};

// Draws the block in all pictures except `gathered`. The block must be at layer 0, and
// block.gathers must be false.
void DrawRendered(const PlannedBlock& planned, StepPictures* pictures);

// Sets pixels of pictures->gathered to white if the engine computes these pixels by filtering
// instead of rendering views.
void MarkGathered(const PlannedBlock& planned, StepPictures* pictures);

// Replaces `percent` of a pixel's colour by `colour`.
void Tint(const uint8_t (&colour)[3], int percent, uint8_t* pixel);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_STEPS_STEP_PICTURES_H_
