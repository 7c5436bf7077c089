// SPDX-License-Identifier: Apache-2.0
// Selects the blocks to measure, for all sizes and all N. Only blocks that occur when the scene is
// refocused are selected.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_SAMPLER_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_SAMPLER_H_

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "examples/lab/calibrate/block_bench.h"
#include "platform/pfm.h"

namespace starfocus {

// Common properties of the blocks in a group.
struct BlockKind {
  int side;   // Size of the block in the picture, in pixels.
  int layer;  // Layer L.
  int n;      // Number of views along the radius, N; 0 at layers 1 and 2 stands for any N.
};

struct BlockGroup {
  BlockKind kind;
  std::vector<BlockTask> tasks;
};

class BlockSampler {
 public:
  explicit BlockSampler(const FloatMap& disparity);

  // Returns one group of random blocks for each kind of block: up to `count` blocks at layer 0, and
  // up to 4 * `count` at layers 1 and 2. Kinds of blocks that do not occur in the scene are
  // omitted.
  std::vector<BlockGroup> Sample(int count);

 private:
  struct Cell {
    float low, high;
  };
  struct Lens {
    double focus, aperture;
  };

  double Random() { return random_() * 0x1p-32; }
  int RandomBelow(int count) { return static_cast<int>(Random() * count); }
  double Radius(const Lens& lens, double disparity) const;
  double LargestRadius(const Lens& lens, const Cell& cell) const;
  double SmallestRadius(const Lens& lens, const Cell& cell) const;
  const Cell& At(int column, int row) const;
  double SmallestRadius(const Lens& lens, const Rect& rect) const;
  double SplattingRadius(const Lens& lens, const Rect& rect) const;
  Lens RandomLens(int pass);
  std::optional<BlockTask> Draw(int pass, const BlockKind& kind);
  Border FindBorder(const Lens& lens, const Rect& rect, int r_max) const;

  const FloatMap& map_;
  int columns_, rows_;
  std::vector<Cell> cells_;
  Cell range_;
  std::mt19937 random_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_SAMPLER_H_
