// SPDX-License-Identifier: Apache-2.0
// Measures the time of refocusing single blocks of a light field, with any position, size, N and
// layer, by the engine's RefocusBlock, and samples the blocks of a light field.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_TIMES_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_TIMES_H_

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "lib/engine/engine.h"
#include "lib/plan/partition.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/result.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// A block, and the lens with which the block is refocused.
struct BlockTask {
  double focus = 0, aperture = 1;
  Block block = {};
};

class BlockBench {
 public:
  // The light field must outlive this object.
  Error Open(const std::string& where, const LightField& light_field);

  // Returns the inputs of the timing model for a block. The position of the block must be a
  // multiple of kCellSize.
  BlockWork Work(const BlockTask& task);

  // Returns the time of refocusing the block once, in picoseconds. Blur radii must not exceed
  // STARFOCUS_MAX_BLUR.
  uint64_t Time(const BlockTask& task);

 private:
  // HoldDisparity and HoldLayer fill the engine's ring buffers and subsampled layers with whole
  // pictures instead of stripes. Therefore, blocks may be refocused in any order.
  void HoldDisparity();
  void HoldLayer(int layer);
  void Focus(const BlockTask& task);

  const LightField* light_field_ = nullptr;
  Engine owner_;
  EngineState* engine_ = nullptr;
  std::vector<int16_t> disparity_;
  std::vector<int16_t> layer_samples_[STARFOCUS_LAYERS];
  Image picture_;
};

// Selects the blocks to measure, for all sizes and all N. Only blocks that occur when the scene is
// refocused are selected.

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

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_TIMES_H_
