// SPDX-License-Identifier: Apache-2.0
// The stripe loop's body: plans the blocks of one stripe, refocuses them and joins them.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_H_

#include <cstdint>

#include "lib/engine/engine.h"
#include "lib/engine/jobs.h"
#include "lib/engine/refocus_block.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// What the engine makes the blocks of a stripe from.
BlockInputs InputsOf(const EngineState& engine);

// Output rows that are final once the stripe that starts at row y is done.
int32_t FinishedRows(const starfocus_config& config, int32_t y);

// The engine's own rows for the stripe that starts at row y, and those before it that it may still
// change.
Plane<uint8_t> BufferRows(const EngineState& engine, int32_t y);

// Refocuses what the lens's region needs of the stripe that starts at row y, a multiple of the
// superblock, into BufferRows; stripes come one after the other. All rows within reach are in
// the windows. After STARFOCUS_ERROR_RUNNER and STARFOCUS_ERROR_CANCELLED the rows are half made
// and the engine is as it was, so that a stripe of a stream can be refocused again.
starfocus_status RefocusStripe(EngineState* engine, int32_t y);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_H_
