// SPDX-License-Identifier: Apache-2.0
// Finds and opens the frames of a video, which are inputs of any format. Frames that are not
// light-field folders are converted to light-field folders in a temporary folder.
#ifndef STARFOCUS_EXAMPLES_CLI_VIDEO_FRAMES_H_
#define STARFOCUS_EXAMPLES_CLI_VIDEO_FRAMES_H_

#include <string>
#include <vector>

#include "examples/cli/input/input.h"
#include "examples/cli/refocus/default_focus.h"
#include "platform/temporary_folder.h"

namespace starfocus {

struct FrameSource {
  std::string path;
  std::string depth;    // path of the depth picture; empty: part of the input, or next to it
  std::string matte;    // path of the matte; empty: part of the input, or none
  std::string picture;  // name of the output picture, which is the name of the input
};

// Returns the frames. If the only input is a folder but not a light field, the frames are the
// photos and light fields in the folder in natural order, without the folder `out`. A row of
// pictures with numbers in their names is a clip and not a light field. If options.depth or
// options.matte is a folder, each frame gets a picture of this folder (depth_folder.h). Prints
// other files in the folders to stderr.
Result<std::vector<FrameSource>> FindFrames(const std::vector<std::string>& inputs,
                                            const InputOptions& options, const std::string& out);

struct FrameFiles {
  std::string folder;         // light-field folder, which may be temporary
  std::string where;          // name of the map for error messages
  Bytes icc;                  // profile of the frame's colours; empty: none
  ColourDescription colours;  // colours without a profile
  bool is_linear = false;     // true if the codes of the views are proportional to light
};

struct Frame {
  FrameFiles files;
  FloatMap map;
  DefaultFocus focus;
};

// Converts frames to light-field folders, and removes these folders at the end.
class FrameFolders {
 public:
  // Opens a frame whose input is already open. Converts the frame unless it is a light-field folder
  // whose map needs no processing. Converted frames contain the views at the positions `views`, or
  // all views if `views` is empty.
  Result<Frame> Open(const MapOptions& options, const Positions& views, int threads,
                     Capture* capture);

 private:
  // Loads the views and the map, processes the map, and writes the folder.
  Error Convert(const MapOptions& options, const Positions& views, int threads, Capture* capture,
                Frame* frame);

  TemporaryFolder folder_;
  int count_ = 0;  // converted frames
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIDEO_FRAMES_H_
