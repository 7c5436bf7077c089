// SPDX-License-Identifier: Apache-2.0
// Times single blocks of a light field, at any place, size, N and layer, through the engine's own
// RefocusBlock.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_

#include <string>
#include <vector>

#include "lib/engine/engine.h"
#include "lib/plan/timing.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

// A lens and a block seen through it.
struct BlockTask {
  double focus = 0, aperture = 1;
  Block block = {};
};

class BlockBench {
 public:
  // The light field must outlive the bench.
  Error Open(const std::string& where, const LightField& light_field);

  // What the timing model knows of the task's block; its place must be a multiple of kCellSize.
  BlockWork Work(const BlockTask& task);

  // Picoseconds to refocus the task's block once. Blur radii must not exceed STARFOCUS_MAX_BLUR.
  uint64_t Time(const BlockTask& task);

 private:
  // The engine's rings and layers hold a stripe; here they hold whole pictures, so that blocks may
  // be refocused in any order.
  void HoldDisparity();
  void HoldLayer(int layer);
  void Focus(const BlockTask& task);

  const LightField* light_field_ = nullptr;
  Engine owner_;
  EngineState* engine_ = nullptr;
  PlaneViews views_;
  std::vector<int16_t> disparity_;
  std::vector<int16_t> layer_samples_[STARFOCUS_LAYERS];
  Image picture_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_BLOCK_BENCH_H_
