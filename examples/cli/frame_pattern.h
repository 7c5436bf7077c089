// SPDX-License-Identifier: Apache-2.0
// Patterns of file names with the number of a frame, as FFmpeg reads and writes them: "in/%05d.png"
// means in/00000.png, in/00001.png and so on. Only the last part of a path may have a number.
#ifndef STARFOCUS_EXAMPLES_CLI_FRAME_PATTERN_H_
#define STARFOCUS_EXAMPLES_CLI_FRAME_PATTERN_H_

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// Returns true if the path has %d or %0Nd in its last part, and no file of this name exists.
bool IsFramePattern(const std::string& path);

// Returns the files of a pattern by their numbers. Returns an error if there are none.
Result<std::map<uint64_t, std::string>> FindPatternFiles(const std::string& pattern);

// Returns the pictures that `path` stands for, in the order of their numbers: the files of a
// pattern or of a folder, or the only file `path`. Returns an error if a number of the pattern is
// missing, or of a folder that has most numbers, because all pictures that follow would be shifted.
Result<std::vector<std::string>> ListPictures(const std::string& path);

// Returns the picture of each frame: the file of the pattern with the last number in the name of
// the frame.
Result<std::vector<std::string>> PairWithPattern(const std::vector<std::string>& frames,
                                                 const std::string& pattern,
                                                 const std::string& kind);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_FRAME_PATTERN_H_
