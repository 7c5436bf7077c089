// SPDX-License-Identifier: Apache-2.0
// Quadtree partition of a superblock by predicted time (paper, V-B), and the timing model (13)-(15)
// that predicts the time.
#ifndef STARFOCUS_LIB_PLAN_PARTITION_H_
#define STARFOCUS_LIB_PLAN_PARTITION_H_

#include <cstdint>

#include "lib/base/config.h"
#include "lib/plan/cells.h"
#include "lib/plan/renderer.h"
#include "lib/plan/smooth_cells.h"

namespace starfocus {

// Returns the predicted time of refocusing a block, in picoseconds. The computation uses integers,
// so that all machines choose the same partition.
uint64_t PredictTime(const starfocus_timing& timing, const BlockWork& work);

// Returns the predicted time of blurring `pixels` pixels of a layer without views, in picoseconds.
// `radius` is the largest blur radius of these pixels, in pixels of the layer (kDisparityBits). The
// blur is a filter like upsampling, so the prediction uses the coefficient of upsampling.
uint64_t PredictGather(const starfocus_timing& timing, uint64_t pixels, int32_t radius);

// Returns the default coefficients, which are the same on all machines, so that all machines split
// a picture in the same way.
starfocus_timing DefaultTiming();

inline constexpr int32_t kSmallestBlock = 16;

// A block to refocus: a rectangle of the picture and its parameters.
struct Block {
  Rect rect;  // block in pixels of the picture, clipped to the picture
  // Rectangle that is rendered from views, in pixels of the layer. The rectangle is LayerFrame, or
  // the part of LayerFrame whose cells require views. The rectangle is empty if no cell requires
  // views.
  Rect rendered;
  Border border;  // Border of `rendered`, in pixels of the layer.
  int32_t layer;  // Layer L.
  int32_t n;      // N, the number of views along the radius.
  bool gathers;   // True: the cells that GatherMap selects are blurred without views.
  bool passes[3] = {true, false, false};  // Passes (lib/engine/engine.h) that the block needs.
  uint64_t cost;                          // Predicted time in picoseconds.
};

// Rules by which PartitionBlock chooses blocks. The rules are the same for all blocks of a
// superblock.
struct PartitionRules {
  const simd::Kernels* kernels;
  const FullConfig* config;
  const Renderer* renderer;
  const ViewWeights* apertures;  // weights of the views for each N, indexed by N up to max_n
  int32_t max_n;
  Demand demand;  // class of the opening, which decides the number of views and the layers
  BlurScale scale;
  int32_t around;        // largest distance in cells over which a pixel may splat
  int32_t largest_side;  // largest allowed side of a block
  int32_t max_layer;
  bool gathers;  // True: smooth cells are blurred without views.
};

// Node of the quadtree. `best` is the predicted time of one block or of its children, whichever is
// smaller.
struct PartitionCandidate {
  BlockStats stats;
  Block block;
  uint64_t best;
  int32_t cells;                       // Number of cells inside the picture.
  int32_t gathered[STARFOCUS_LAYERS];  // Cells that can be blurred without views, per layer.
  // Predicted time of blurring all `gathered` cells, for each layer.
  uint64_t gather[STARFOCUS_LAYERS];
};

// Returns the largest number of blocks that a superblock splits into.
constexpr int32_t MaxBlocks(int32_t superblock) {
  return (superblock / kSmallestBlock) * (superblock / kSmallestBlock);
}

// Returns the number of candidates in the quadtree of a superblock.
constexpr int32_t PartitionCandidates(int32_t superblock) {
  int32_t candidates = 0;
  for (int32_t side = superblock / kSmallestBlock; side > 0; side /= 2) candidates += side * side;
  return candidates;
}

// Divides the superblock at (x, y) into the blocks with the smallest predicted time. x and y are
// multiples of the superblock size. Writes at most MaxBlocks blocks in z-order, and the part of
// `gathered` that belongs to the superblock. Returns the number of blocks. Scratch memory:
// PartitionCandidates candidates, and SurroundingSamples samples for the cells.
int32_t PartitionBlock(const PartitionRules& rules, const CellGrid& cells, int32_t x, int32_t y,
                       PartitionCandidate* candidates, int16_t* samples, const GatherMap& gathered,
                       Block* blocks);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_PLAN_PARTITION_H_
