// SPDX-License-Identifier: Apache-2.0
// Frames of a Y4M stream, as the input of `video`. Their depth maps or mattes are the pictures of a
// folder or pattern in the order of their numbers, one picture for all frames, or the luma of a
// second Y4M stream in a file. All maps are measured before the first frame is refocused, because
// one scale applies to all frames; the stream itself is read once.
#ifndef STARFOCUS_EXAMPLES_CLI_STREAM_CLIP_H_
#define STARFOCUS_EXAMPLES_CLI_STREAM_CLIP_H_

#include <cstddef>
#include <string>
#include <vector>

#include "examples/cli/input_options.h"
#include "platform/readers/capture.h"
#include "platform/result.h"
#include "platform/y4m.h"

namespace starfocus {

// Returns true if the inputs of a command are one Y4M stream: "-", or a file with this content.
bool IsStream(const std::vector<std::string>& inputs);

// Maps of the frames of a stream.
class MapTrack {
 public:
  // Lists the pictures of `path`, or opens a Y4M stream. An empty path has no maps.
  Error Open(const std::string& path);
  bool is_empty() const { return path_.empty(); }
  const std::string& path() const { return path_; }
  // Returns true if one picture applies to all frames.
  bool is_single() const { return !is_stream_ && pictures_.size() == 1; }
  // Number of maps of a track that is neither empty nor single.
  size_t frames() const { return is_stream_ ? frames_ : pictures_.size(); }
  // Returns the file of the map of a frame.
  const std::string& FileOf(size_t frame) const;
  // Reads a map, as fast as possible in the order of the frames.
  Result<Samples> Read(size_t frame, Alpha alpha, const DepthOptions& options);

 private:
  Result<Samples> ReadStream(size_t frame);

  std::string path_;
  std::vector<std::string> pictures_;
  bool is_stream_ = false;
  size_t frames_ = 0;
  Y4mReader reader_;
};

class StreamClip {
 public:
  // Opens the stream and its maps, and checks the options.
  Error Open(const std::string& path, const InputOptions& options);

  const Y4mHeader& header() const { return reader_.header(); }
  const std::string& where() const { return where_; }
  // Number of maps; 0: one map for all frames, whose number is unknown.
  size_t maps() const;
  // Returns the files that no output may overwrite.
  std::vector<std::string> Files() const;

  // Opens the map of a frame, which is interpreted by the figures of the clip, or by its own
  // figures if `clip` is null. The capture has no pixels, and its map may have any size.
  Result<Capture> OpenMapOf(size_t frame, const MapSurvey* clip);

  // Reads the next frame, and opens its map. Returns false at the end.
  Result<bool> Next(const MapSurvey& clip, Capture* capture);

  // Prints a note if the stream had fewer frames than maps.
  void TellEnd() const;

 private:
  std::string path_, where_;
  DepthOptions map_;
  Y4mReader reader_;
  MapTrack depths_, mattes_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_STREAM_CLIP_H_
