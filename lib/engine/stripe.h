// SPDX-License-Identifier: Apache-2.0
// Refocuses one stripe: plans its blocks, renders them and deblocks their boundaries.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "lib/engine/refocus_block.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the inputs of the blocks of a stripe.
BlockInputs InputsOf(const EngineState& engine);

// Returns the number of output rows that are final after the stripe at row y.
int32_t FinishedRows(const starfocus_config& config, int32_t y);

// Returns the output buffer for the stripe at row y. The buffer also contains the rows above the
// stripe that the stripe may still change.
Plane<uint8_t> BufferRows(const EngineState& engine, int32_t y);

// Refocuses the part of the stripe at row y that affects the region of the lens, into BufferRows.
// `y` must be a multiple of the superblock size, and stripes must be refocused in order. The
// input must contain all rows within the borders of the stripe. After
// STARFOCUS_ERROR_RUNNER and STARFOCUS_ERROR_CANCELLED the rows are unspecified and the state of
// the engine is restored, so that a stream can refocus the stripe again.
starfocus_status RefocusStripe(EngineState* engine, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_H_
