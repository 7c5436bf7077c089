// SPDX-License-Identifier: Apache-2.0
// Timing-based quadtree partition of a superblock (paper, V-B).
#ifndef STARFOCUS_LIB_PLAN_PARTITION_H_
#define STARFOCUS_LIB_PLAN_PARTITION_H_

#include <cstdint>

#include "lib/plan/block_stats.h"
#include "lib/plan/gathered_cells.h"
#include "lib/plan/neighbourhood.h"
#include "lib/plan/renderer.h"

namespace starfocus {

inline constexpr int32_t kSmallestBlock = 16;

// A block to refocus: a rectangle of the picture with its parameters.
struct Block {
  Rect rect;  // in pixels of the picture, clipped to it
  // Of views, at the layer: LayerFrame, or what of it holds the cells that are not gathered, and
  // empty when all are.
  Rect rendered;
  Border border;        // of `rendered`, at the layer
  int32_t layer;        // L
  int32_t n;            // N
  bool gathers;         // the cells of the map
  bool has_highlights;  // views may show some: rendered twice
  uint64_t cost;        // predicted, picoseconds
};

struct PartitionRules {
  const starfocus_config* config;
  const Renderer* renderer;
  const ViewWeights* apertures;  // of the renderer by N, up to max_n
  int32_t max_n;
  Demand demand;  // of the opening
  BlurScale scale;
  int32_t largest_side;  // side of the largest block that is made
  int32_t max_layer;
  bool gathers;         // smooth cells, with cells
  bool has_highlights;  // of the blocks
};

// A square of the quadtree: what it is as one block, and the least time of it or its children.
struct PartitionCandidate {
  BlockStats stats;
  Block block;
  uint64_t best;
  int32_t cells;                       // inside the picture
  int32_t gathered[STARFOCUS_LAYERS];  // those of them that could be, at each layer
  uint64_t gather[STARFOCUS_LAYERS];   // predicted time of that
};

// Blocks a superblock can split into.
constexpr int32_t MaxBlocks(int32_t superblock) {
  return (superblock / kSmallestBlock) * (superblock / kSmallestBlock);
}

// Candidates in the quadtree of a superblock.
constexpr int32_t PartitionCandidates(int32_t superblock) {
  int32_t candidates = 0;
  for (int32_t side = superblock / kSmallestBlock; side > 0; side /= 2) candidates += side * side;
  return candidates;
}

// Memory for a superblock: PartitionCandidates of it, SurroundingSamples of its cells.
struct PartitionScratch {
  PartitionCandidate* candidates;
  int16_t* cells;
};

// What a partition is made from.
struct PlanInput {
  const simd::Kernels& kernels;
  const PartitionRules& rules;
  const CellGrid& cells;
  int32_t around;  // how many cells away a pixel may splat from
};

// Splits the superblock at (x, y), multiples of superblock, into the blocks of least
// predicted time. Writes at most MaxBlocks blocks in z-order, and what of `gathered` belongs to the
// superblock; returns the number of blocks.
int32_t PartitionBlock(const PlanInput& input, int32_t x, int32_t y,
                       const PartitionScratch& scratch, Block* blocks, const GatherMap& gathered);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_PARTITION_H_
