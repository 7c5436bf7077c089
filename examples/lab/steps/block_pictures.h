// SPDX-License-Identifier: Apache-2.0
// Draws the surfaces, slices and views of one block. DrawSteps calls these functions while the
// engine plans a stripe.
#ifndef STARFOCUS_EXAMPLES_LAB_STEPS_BLOCK_PICTURES_H_
#define STARFOCUS_EXAMPLES_LAB_STEPS_BLOCK_PICTURES_H_

#include "examples/lab/steps/step_pictures.h"
#include "lib/engine/engine.h"

namespace starfocus {

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

#endif  // STARFOCUS_EXAMPLES_LAB_STEPS_BLOCK_PICTURES_H_
