// One block: refocused at its layer and brought back to the picture.
#ifndef STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
#define STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_

#include "lib/engine/engine.h"

namespace starfocus {

// Writes the block's rectangle of the picture into `out` and counts it in worker->counts.
void RefocusBlock(const EngineState& engine, const Block& block, const Plane<uint8_t>& out,
                  Worker* worker);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
