// Times single blocks of a light field, at any place, size, N and layer, through the engine's own
// RefocusBlock.
#ifndef STARFOCUS_EXAMPLES_CLI_CALIBRATE_BLOCK_BENCH_H_
#define STARFOCUS_EXAMPLES_CLI_CALIBRATE_BLOCK_BENCH_H_

#include <string>
#include <vector>

#include "examples/cli/engine/engine_run.h"
#include "lib/engine/engine.h"
#include "lib/plan/timing.h"
#include "platform/instruction_counter.h"
#include "platform/light_field.h"

namespace starfocus {

// What an instruction stands for where instructions are counted instead of time: two a cycle at
// 2 GHz. Only ratios matter to a partition.
inline constexpr uint64_t kPicosecondsPerInstruction = 250;

// A lens and a block seen through it.
struct BlockTask {
  double focus = 0, aperture = 1;
  Block block = {};
};

class BlockBench {
 public:
  // The light field must outlive the bench. Returns an error line, empty for success.
  std::string Open(const std::string& where, const LightField& light_field);

  // From now on Time() counts instructions with `counter`; null: processor time.
  void CountWith(const InstructionCounter* counter) { counter_ = counter; }

  // What the timing model knows of the task's block; its place must be a multiple of kCellSize.
  BlockWork Work(const BlockTask& task);

  // Picoseconds to refocus the task's block once. Blur radii must not exceed SF_MAX_BLUR.
  uint64_t Time(const BlockTask& task);

 private:
  // The engine's rings and layers hold a stripe; here they hold whole pictures, so that blocks may
  // be refocused in any order.
  void HoldDisparity();
  void HoldLayer(int layer);
  void Focus(const BlockTask& task);
  uint64_t Now() const;  // picoseconds from some start

  const LightField* light_field_ = nullptr;
  const InstructionCounter* counter_ = nullptr;
  Workspace workspace_;
  EngineState* engine_ = nullptr;
  std::vector<int16_t> disparity_;
  std::vector<uint8_t> layer_rgb_[SF_LAYERS];
  std::vector<int16_t> layer_samples_[SF_LAYERS], layer_half_[SF_LAYERS];
  Image picture_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_CALIBRATE_BLOCK_BENCH_H_
