// SPDX-License-Identifier: Apache-2.0
// Finds stereo pairs whose pictures are in two folders, left and right, as stereo cameras and data
// sets store them.
#ifndef STARFOCUS_PLATFORM_READERS_STEREO_FOLDERS_H_
#define STARFOCUS_PLATFORM_READERS_STEREO_FOLDERS_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Paths of the pictures of a stereo pair.
struct StereoFiles {
  std::string left, right;
};

// Lists the stereo pairs of a folder that contains the folders `left` and `right`, sorted by name.
// A pair consists of the pictures of the same name, or of the only picture in each folder. Returns
// an empty list if the folder has no such folders or contains pictures itself, and an error if a
// picture has no counterpart.
Result<std::vector<StereoFiles>> FindStereoFolders(const std::string& folder);

// Returns the path of the right picture of a left picture: `left` in the path of the folder is
// replaced by `right`. Returns an empty string if there is no such file.
std::string FindRightPicture(const std::string& left);

}  // namespace starfocus

#endif  // STARFOCUS_PLATFORM_READERS_STEREO_FOLDERS_H_
