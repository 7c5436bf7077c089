// SPDX-License-Identifier: Apache-2.0
// Refocuses one block: renders the block at its layer and upsamples the result to the picture.
#ifndef STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
#define STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_

#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/engine/lens.h"
#include "lib/engine/scratch.h"
#include "lib/engine/tables.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "lib/plan/cells.h"
#include "lib/plan/partition.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Inputs that the blocks of a stripe share.
struct BlockInputs {
  const starfocus_config* config;
  const simd::Kernels* kernels;
  const Tables* tables;
  const Lens* lens;
  const Input* input;
  const CellGrid* cells;
  const GatherMap* gathered;
  starfocus_clock clock;  // a null clock disables measuring the time of blocks
};

// Returns the grid of the views that the block is rendered from. `weights` is memory for the
// weights of an aperture with a cat's eye: FullApertureSize(N) elements.
ViewGrid ViewGridOf(const BlockInputs& in, const Block& block, uint16_t* weights);

// Writes the rectangle of the block to `out` and adds the block to scratch->counts.
void RefocusBlock(const BlockInputs& in, const Block& block, const Plane<uint8_t>& out,
                  Scratch* scratch);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_REFOCUS_BLOCK_H_
