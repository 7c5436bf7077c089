// SPDX-License-Identifier: Apache-2.0
// Measures the time of refocusing single blocks of a light field, with any position, size, N and
// layer. Calls the engine's RefocusBlock directly.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_

#include <string>
#include <vector>

#include "lib/engine/engine.h"
#include "lib/plan/partition.h"
#include "platform/light_field.h"
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

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_
