// SPDX-License-Identifier: Apache-2.0
// Finds and opens the frames of a video, which are inputs of any format, and pairs them with depth
// pictures or mattes in a folder of their own. All frames are checked before work begins.
#ifndef STARFOCUS_EXAMPLES_CLI_FRAMES_H_
#define STARFOCUS_EXAMPLES_CLI_FRAMES_H_

#include <functional>
#include <string>
#include <vector>

#include "examples/cli/input.h"
#include "examples/cli/input_options.h"
#include "platform/readers/map_survey.h"
#include "platform/result.h"

namespace starfocus {

struct FrameSource {
  std::string path;
  std::string depth;    // path of the depth picture; empty: part of the input, or next to it
  std::string matte;    // path of the matte; empty: part of the input, or none
  std::string picture;  // name of the output picture, which is the name of the input
};

// Returns the frames. If the only input is a folder but not a light field, the frames are the
// photos and light fields in the folder in natural order, without the folder `out`. A row of
// pictures with numbers in their names is a clip and not a light field. A pattern such as
// "in/%05d.png" (frame_pattern.h) means all its files. If options.depth or options.matte is a
// folder or a pattern, each frame gets one of its pictures. Output pictures are PNG or, unless
// `has_8_bits` is true, have the format that keeps the bits of the frame (DeepExtensionOf). Prints
// other files in the folders to stderr.
Result<std::vector<FrameSource>> FindFrames(const std::vector<std::string>& inputs,
                                            const InputOptions& options, const std::string& out,
                                            bool has_8_bits);

// Returns the options that open one frame.
InputOptions OptionsOf(const InputOptions& options, const FrameSource& frame);

// Opens a frame, whose depth map is interpreted by the figures of the clip, or by its own figures
// if `clip` is null.
using OpenMap = std::function<Result<Capture>(size_t frame, const MapSurvey* clip)>;

// Opens the frames one after another. Returns an error if a frame has no depth, if its size differs
// from the first frame, or if the values of its depth map are of another kind. Otherwise returns
// the sum of the figures of all depth maps, which stands for the figures of each map
// (DepthOptions::clip). At most one frame is in memory.
Result<MapSurvey> SurveyClip(size_t frames, const OpenMap& open);

// Returns the path of the depth picture of each frame or, if `ending` is "matte" and not "depth",
// of its matte. A picture belongs to a frame
// - if their names without extension are equal, or the name of the picture ends in -depth, _depth
//   or .depth (with the given ending) in addition; or
// - if this pairs not all frames, by the numbers in the names, with or without leading zeros. All
//   pictures then have one name apart from their numbers. Numbers that all frames have in common,
//   such as the number of a shot, may be missing in the names of the pictures.
// Returns an error unless each frame has exactly one picture. Prints a note if the folder has other
// pictures.
Result<std::vector<std::string>> PairWithFolder(const std::vector<std::string>& frames,
                                                const std::string& folder,
                                                const std::string& ending);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_FRAMES_H_
