// SPDX-License-Identifier: Apache-2.0
// Estimates the depth of photos by a command of the user (--depth-command).
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_PICTURE_COMMAND_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_PICTURE_COMMAND_H_

#include <map>
#include <string>

#include "platform/image.h"
#include "platform/levels.h"
#include "platform/result.h"
#include "platform/temporary_folder.h"

namespace starfocus {

struct DepthCommand {
  std::string command;  // empty: none
  int seconds = 600;    // time limit
};

// Returns a description of the expected command if `text` lacks {input} or {output}, otherwise "".
std::string CheckDepthCommand(const std::string& text);

// Writes `photo` to a PNG file in a temporary folder, and runs the command with the paths of the
// PNG file and of the depth picture in place of {input} and {output}. Reads the depth picture
// (depth_file.h) and removes the folder. The command may add text to the name of the depth picture.
// `alpha` states how transparent pixels of the depth picture are treated. Error messages start
// with `name`, which is the name of the photo. Several threads may call the function at the same
// time.
Result<Samples> RunDepthCommand(const std::string& name, const DepthCommand& command, Alpha alpha,
                                const Image& photo);

// Estimates that are kept in temporary files, so that a photo can be opened several times. The name
// of a photo identifies its estimate. Only one thread may use the object.
class KeptEstimates {
 public:
  // Returns the kept estimate of the photo `name`, or runs the command (RunDepthCommand).
  Result<Samples> Of(const std::string& name, const DepthCommand& command, Alpha alpha,
                     const Image& photo);

 private:
  struct Kept {
    std::string path;
    int largest;
    bool larger_is_nearer;
  };

  TemporaryFolder folder_;
  std::map<std::string, Kept> kept_;
};

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_PICTURE_COMMAND_H_
