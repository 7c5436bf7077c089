// SPDX-License-Identifier: Apache-2.0
// Pairs the frames of a video with depth pictures in a folder of their own.
#ifndef STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_
#define STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Returns the path of the depth picture of each frame. A depth picture belongs to a frame
// - if their names without extension are equal, or the name of the depth picture ends in -depth,
//   _depth or .depth in addition; or
// - if this pairs not all frames, by the numbers in the names, with or without leading zeros. All
//   depth pictures then have one name apart from their numbers. Numbers that all frames have in
//   common, such as the number of a shot, may be missing in the names of the depth pictures.
// Returns an error unless each frame has exactly one depth picture. Prints a note if the folder has
// other depth pictures.
Result<std::vector<std::string>> PairWithFolder(const std::vector<std::string>& frames,
                                                const std::string& folder);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIDEO_DEPTH_FOLDER_H_
