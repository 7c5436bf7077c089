// SPDX-License-Identifier: Apache-2.0
// The frames of a video, for the command `video`: opens the files of the frames or a stream,
// measures all maps, and plans the lens of each frame before the first frame is refocused. Maps are
// stabilised and repaired when their frame is refocused, so that at most a few frames are in
// memory.
#ifndef STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_
#define STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/frames.h"
#include "examples/cli/input_options.h"
#include "examples/cli/lens_keys.h"
#include "examples/cli/map_stabiliser.h"
#include "examples/cli/refocus_plan.h"
#include "examples/cli/stages.h"
#include "examples/cli/stream_clip.h"
#include "platform/result.h"
#include "platform/temporary_folder.h"

namespace starfocus {

struct VideoOptions {
  std::vector<std::string> inputs;
  InputOptions input;  // options of each input
  std::string out, report;
  LensOptions lens;
  LensKeyOptions keys;
  MapOptions map;
  bool stabilise = false, no_stabilise = false;
};

// Frames of a video and their common properties.
struct Video {
  bool is_stream = false;  // true: the frames are those of `stream`; false: of `sources`
  StreamClip stream;
  std::vector<FrameSource> sources;
  MapSurvey survey;  // of the depth maps of all frames
  KeptPictures computed;
  TemporaryFolder estimates;                  // of maps that were estimated from views
  std::unique_ptr<MapStabiliser> stabiliser;  // null before the first map that is stabilised
  int width = 0, height = 0;
  Positions views;
  bool is_linear = false;  // true if the codes of the frames are proportional to light
  bool is_deep = false;    // true if the first frame has codes of more than 8 bits
  DisparityRange given;    // over all frames, of the maps as they come
  starfocus_disparity_stats stats = {};  // of `given`, and what a repair may add
  double max_blur = 0;
  std::vector<FocusKey> focus_keys;
  std::vector<ApertureKey> aperture_keys;

  // Returns the name of the first frame, for notes about all frames.
  const std::string& first() const { return is_stream ? stream.where() : sources[0].path; }
  // Returns true if the focus follows a subject.
  bool tracks() const {
    return std::any_of(focus_keys.begin(), focus_keys.end(),
                       [](const FocusKey& key) { return key.tracks; });
  }
  // Returns the number of frames; 0: unknown.
  size_t count() const { return is_stream ? stream.maps() : sources.size(); }
};

// Returns the name of the picture of a frame of a stream.
std::string NumberedPicture(size_t frame);

// Returns true if the centre view has codes of sRGB of more than 8 bits, without alpha. A Y4M
// stream of such pictures has 10 bits.
bool HasDeepCodes(const LightField& light_field);

// Reads the keys, and checks that no other option sets what they set.
Error ReadLensKeys(const VideoOptions& options, Video* video);

// Finds the inputs: a stream and its maps, or the files of the frames.
Error FindInput(const VideoOptions& options, Video* video);

// Returns an error if a key is behind the last frame. The inputs must have been found.
Error CheckKeyFrames(const Video& video);

// Opens all frames, or all maps of a stream, and fits the lens to them.
Error ScanVideo(const VideoOptions& options, LensPlan* plan, Video* video);

// Stages: read a frame with its map; stabilise the map, and find the focus; repair the map.
Result<bool> ReadFrame(const VideoOptions& options, const LensPlan& plan, Video* video,
                       ClipFrame* frame);
Result<bool> StabiliseFrame(const VideoOptions& options, const LensPlan& plan, Video* video,
                            ClipFrame* frame);
Result<bool> RepairFrame(const VideoOptions& options, const LensPlan& plan, ClipFrame* frame);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIDEO_CLIP_H_
