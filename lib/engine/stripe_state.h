// SPDX-License-Identifier: Apache-2.0
// The state of a stripe, and what the next one takes over from it.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_

#include <cstdint>

#include "lib/coverage/passes.h"
#include "lib/engine/frame_diff.h"
#include "lib/filter/deblock.h"
#include "lib/plan/block_stats.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// A stripe of superblocks: rows [y, y + height) of the picture.
struct Stripe {
  int32_t y, height;
};

// The blocks of a stripe. Each superblock is planned into memory of its own; those that are to
// be refocused then lie one behind the other at the beginning.
struct StripePlan {
  int32_t side;        // of superblocks, pixels
  int32_t columns;     // of superblocks
  uint8_t* wanted;     // per superblock: some of its pixels are needed
  uint8_t* measured;   // per superblock: its cells are needed
  bool all_measured;   // whether the stripe before needed the cells of every column
  Block* blocks;       // MaxBlocks per superblock
  int32_t* counts;     // how many blocks each was split into
  int32_t used;        // how many blocks are to be refocused
  GatherMap gathered;  // which cells are gathered, in block mode

  Block* BlocksOf(int32_t column) const {
    return blocks + static_cast<size_t>(column) * static_cast<size_t>(MaxBlocks(side));
  }
};

// The coverage map, and the first row of tiles that each pass has not done yet; below 0: it has
// done none.
struct CoverageState {
  Plane<uint8_t> given;  // with streaming: ring of the light field's coverage
  CoverageMap map;
  int32_t done[kCoveragePasses];
};

struct StripeState {
  CellGrid cells;          // of the stripe, and as far around it as pixels splat
  CoverageState coverage;  // of the stripe, and of the rows around it
  StripePlan plan;
  LayerMap map;       // which layer each smallest block has, for deblocking
  FrameDiff changes;  // which blocks differ from the light field before
  uint8_t* out;       // kDeblockRows and a stripe, packed
  // With streaming: the last kDeblockRows of the stripe before, as it left them. Else null: what
  // fails is not gone on with, so that they can stay where they are.
  uint8_t* last_rows;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_
