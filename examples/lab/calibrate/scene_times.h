// SPDX-License-Identifier: Apache-2.0
// Measures the times of blocks of scenes, and fits the timing model (14) to them by least squares.
#ifndef STARFOCUS_EXAMPLES_LAB_CALIBRATE_SCENE_TIMES_H_
#define STARFOCUS_EXAMPLES_LAB_CALIBRATE_SCENE_TIMES_H_

#include <string>
#include <vector>

#include "examples/cli/engine_run.h"
#include "examples/lab/calibrate/block_times.h"
#include "platform/light_field.h"
#include "platform/progress.h"
#include "platform/result.h"
#include "starfocus/experimental.h"

namespace starfocus {

struct Measurement {
  BlockWork work;
  double picoseconds;
};

// Returns the non-negative coefficients that minimize the weighted sum of squared errors. The
// weight of a block is the reciprocal of its measured time. This weight is a compromise between
// absolute and relative errors, so that small blocks have an influence.
starfocus_timing FitTiming(const std::vector<Measurement>& measurements);

// Coefficients of determination R^2: without weights, and with the weights of the fit.
struct Agreement {
  double plain, weighted;
};
Agreement Compare(const starfocus_timing& timing, const std::vector<Measurement>& measurements);

// Measures the times of one scene's blocks.

class SceneTimes {
 public:
  // Selects the blocks.
  Error Open(const std::string& name, LightField light_field);

  const std::string& name() const { return name_; }
  int64_t blocks() const { return blocks_; }

  // Measures every block once. Repeated calls keep the shortest time of each block, because
  // disturbances can only lengthen a measured time.
  void Measure(Progress* progress);

  // Return the measurements of all blocks, and their means for every configuration, which is a
  // group of blocks with the same size and N.
  std::vector<Measurement> Blocks() const;
  std::vector<Measurement> Configurations() const;

 private:
  struct Timed {
    BlockTask task;
    Measurement measurement;
  };

  std::string name_;
  LightField light_field_;
  BlockBench bench_;
  std::vector<std::vector<Timed>> groups_;
  int64_t blocks_ = 0;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_CALIBRATE_SCENE_TIMES_H_
