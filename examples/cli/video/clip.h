// SPDX-License-Identifier: Apache-2.0
// Checks all frames of a clip before work begins, and finds what their depth maps have in common.
#ifndef STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_
#define STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_

#include <string>
#include <vector>

#include "examples/cli/input/input_options.h"
#include "examples/cli/video/frames.h"
#include "platform/readers/map_survey.h"
#include "platform/result.h"

namespace starfocus {

// Returns the options that open one frame.
InputOptions OptionsOf(const InputOptions& options, const FrameSource& frame);

// Opens the frames one after another. Returns an error if a frame has no depth, if its size differs
// from the first frame, or if the values of its depth map are of another kind. Otherwise returns
// the sum of the figures of all depth maps, which stands for the figures of each map
// (DepthOptions::clip). At most one frame is in memory.
Result<MapSurvey> SurveyClip(const std::vector<FrameSource>& frames, const InputOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_
