// SPDX-License-Identifier: Apache-2.0
// The stabiliser of the maps of a video, with its memory.
#ifndef STARFOCUS_EXAMPLES_CLI_MAP_STABILISER_H_
#define STARFOCUS_EXAMPLES_CLI_MAP_STABILISER_H_

#include <memory>
#include <new>
#include <string>

#include "examples/cli/estimate_run.h"
#include "platform/light_field.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "starfocus/video.h"

namespace starfocus {

class MapStabiliser {
 public:
  // Stabilised disparities lie within `range`, which contains those of all frames.
  explicit MapStabiliser(int threads,
                         DisparityRange range = {-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY})
      : pool_(threads), range_(range) {}

  // Stabilises the map and the coverage of the next frame. All frames have the size of the first.
  // `path` names the frame in messages. `report` may be null.
  Error Stabilise(const std::string& path, LightField* frame, starfocus_stabiliser_report* report);

  // Returns the stabiliser of the frames so far, or null before the first frame.
  starfocus_stabiliser* get() const { return stabiliser_; }

 private:
  struct FreeAligned {
    void operator()(void* memory) const {
      ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
    }
  };

  Error Start(const std::string& path, const LightField& frame);

  ThreadRunner pool_;
  DisparityRange range_;
  std::unique_ptr<void, FreeAligned> memory_;
  starfocus_stabiliser* stabiliser_ = nullptr;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_MAP_STABILISER_H_
