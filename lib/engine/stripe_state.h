// SPDX-License-Identifier: Apache-2.0
// State of a stripe, including the parts that the next stripe reuses.
#ifndef STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_
#define STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_

#include <cstdint>

#include "lib/engine/deblock.h"
#include "lib/engine/frame_diff.h"
#include "lib/matting/passes.h"
#include "lib/plan/cells.h"
#include "lib/plan/partition.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Stripe of superblocks: rows [y, y + height) of the picture.
struct Stripe {
  int32_t y, height;
};

// Blocks of a stripe. Planning stores the blocks of each superblock in a separate part of `blocks`.
// After planning, the blocks to refocus are moved to the start of `blocks`.
struct StripePlan {
  int32_t side;        // Side of a superblock in pixels.
  int32_t columns;     // Number of columns of superblocks.
  uint8_t* wanted;     // Per superblock: 1 if the superblock is refocused.
  uint8_t* measured;   // Per superblock: 1 if its cells are measured.
  bool all_measured;   // True: the previous stripe measured the cells of every column.
  Block* blocks;       // Memory for MaxBlocks blocks per superblock.
  int32_t* counts;     // Number of blocks of each superblock.
  int32_t used;        // Number of blocks to refocus.
  GatherMap gathered;  // In block mode, the cells that are blurred without views.

  Block* BlocksOf(int32_t column) const {
    return blocks + static_cast<size_t>(column) * static_cast<size_t>(MaxBlocks(side));
  }
};

// Coverage map, and the first row of tiles that each pass has not processed yet. The entry in
// `done` is negative if the pass has not processed any row.
struct CoverageState {
  CoverageMap map;
  int32_t done[kCoveragePasses];
};

struct StripeState {
  CellGrid cells;  // Cells of the stripe and of the surroundings that splat into the stripe.
  CoverageState coverage;  // Coverage of the stripe and of the rows around the stripe.
  StripePlan plan;
  LayerMap map;       // Layer of each smallest block, for deblocking.
  FrameDiff changes;  // Superblocks that differ from the previous light field.
  // Output: the last kDeblockRows rows of the previous stripe, and the stripe, packed.
  uint8_t* out;
  // With streaming: the last kDeblockRows rows of the previous stripe, saved when that stripe was
  // finished. Null without streaming, because a failed call is not resumed and the last rows can
  // stay in `out`.
  uint8_t* last_rows;
};

}  // namespace starfocus

#endif  // STARFOCUS_LIB_ENGINE_STRIPE_STATE_H_
