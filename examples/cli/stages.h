// SPDX-License-Identifier: Apache-2.0
// Runs the stages of a video: each frame passes through all stages, and each stage gets the frames
// in their order, one at a time. With several threads, the stages work on successive frames at the
// same time.
#ifndef STARFOCUS_EXAMPLES_CLI_STAGES_H_
#define STARFOCUS_EXAMPLES_CLI_STAGES_H_

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/engine_run.h"
#include "platform/readers/capture.h"
#include "platform/result.h"

namespace starfocus {

// A frame on its way through the stages.
struct ClipFrame {
  size_t index = 0;
  std::string where;    // name of the frame for messages
  std::string picture;  // file name of its picture in an output folder
  // The light field, with the metadata of the picture. The stage that refocuses the frame takes the
  // light field out, except for its deep_colours.
  Capture capture;
  double focus = 0;  // disparity in focus, if there are --focus-keys; set with the stabilised map
  std::shared_ptr<const EngineResult> result;  // null before the frame is refocused
};

// A stage of the processing. Returns false to end the video without an error. The first stage,
// which reads frames, does so after the last frame, and the last stage when its output is closed.
using Stage = std::function<Result<bool>(ClipFrame* frame)>;

// Runs the stages until the first stage has no more frame. If a stage fails, the frames before the
// failing frame still pass through the following stages. Returns the error of the earliest frame.
// The memory contains at most two frames for each stage.
// @param overlap true: each stage has a thread of its own
Error RunStages(const std::vector<Stage>& stages, bool overlap);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_STAGES_H_
