// SPDX-License-Identifier: Apache-2.0
// Outputs of `video`: a folder of pictures, a Y4M stream on standard output, or an animation in
// WebP.
#ifndef STARFOCUS_EXAMPLES_CLI_CLIP_OUTPUT_H_
#define STARFOCUS_EXAMPLES_CLI_CLIP_OUTPUT_H_

#include <memory>
#include <string>

#include "examples/cli/stages.h"
#include "platform/result.h"
#include "platform/y4m.h"

namespace starfocus {

enum class ClipKind { kFolder, kStream, kAnimation };

// Returns the kind of the output that --output selects.
ClipKind KindOfClip(const std::string& out);

// Returns an error if --output is a file that `video` does not write. The error for a video
// contains the command that makes the video with FFmpeg.
Error CheckClipName(const std::string& out);

class ClipOutput {
 public:
  virtual ~ClipOutput() = default;

  // Writes the picture of the next frame. Returns false if the reader of a pipe has closed it.
  virtual Result<bool> Write(const ClipFrame& frame) = 0;
  // Completes the output after all frames.
  virtual Error Finish() { return {}; }
};

// Makes the output `out`. `header` describes the frames of a stream, and has the duration of a
// frame of an animation. No file or folder exists before the first frame is written.
std::unique_ptr<ClipOutput> MakeClipOutput(const std::string& out, const Y4mHeader& header);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_CLIP_OUTPUT_H_
