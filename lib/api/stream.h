// SPDX-License-Identifier: Apache-2.0
// How far a streamed refocusing has come, whatever its rows are made of.
#ifndef STARFOCUS_LIB_API_STREAM_H_
#define STARFOCUS_LIB_API_STREAM_H_

#include "lib/engine/engine.h"

namespace starfocus {

// Input rows that the next stripe reads.
int32_t NeededRows(const EngineState& engine);

// Whether there are finished rows that were not pulled.
bool StripeWaiting(const EngineState& engine);

// Refocuses the next stripe, whose rows must have been pushed.
sf_status RefocusNext(EngineState* engine, const Runner& runner);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_API_STREAM_H_
