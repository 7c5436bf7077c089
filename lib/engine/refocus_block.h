// SPDX-License-Identifier: Apache-2.0
// One block: refocused at its layer and brought back to the picture.
#ifndef STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
#define STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_

#include "lib/base/geometry.h"
#include "lib/engine/lens.h"
#include "lib/engine/scratch.h"
#include "lib/engine/tables.h"
#include "lib/input/window.h"
#include "lib/plan/block_stats.h"
#include "lib/plan/partition.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// What the blocks of a stripe are made from.
struct BlockInputs {
  const starfocus_config* config;
  const simd::Kernels* kernels;
  const Tables* tables;
  const Lens* lens;
  const Window* windows;  // of each layer
  const CellGrid* cells;
  const GatherMap* gathered;
  starfocus_clock clock;  // null: blocks are not timed
};

// Writes the block's rectangle of the picture into `out` and counts it in scratch->counts.
void RefocusBlock(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                  Scratch* scratch);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
