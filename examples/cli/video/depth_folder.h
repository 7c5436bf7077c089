// SPDX-License-Identifier: Apache-2.0
// Pairs the frames of a video with depth pictures or mattes in a folder of their own.
#ifndef STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_
#define STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

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

#endif  // STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_
