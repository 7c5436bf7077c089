// SPDX-License-Identifier: Apache-2.0
// Options of commands that open light fields and photos. --depth-command and --matte-command run a
// command of the user that computes a depth picture or a matte.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_OPTIONS_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_OPTIONS_H_

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/image.h"
#include "platform/levels.h"
#include "platform/readers/depth_options.h"
#include "platform/result.h"
#include "platform/temporary_folder.h"

namespace starfocus {

struct PictureCommand {
  const char* kind;       // "depth" or "matte": part of the names of files and of error messages
  const char* picture;    // what the command computes, for error messages
  std::string line = {};  // shell command with {input} and {output}; empty: none
};

// Returns a description of the expected command if `line` lacks {input} or {output}, otherwise "".
std::string CheckPictureCommand(const std::string& line);

// A photo from which a command computes a picture.
struct CommandInput {
  std::string name;  // name of the photo
  const Image& photo;
  Alpha alpha;  // treatment of the alpha channel of the computed picture
  int seconds;  // time limit
};

// Writes the photo to a PNG file in a temporary folder, and runs the command with the paths of the
// PNG file and of the computed picture in place of {input} and {output}. Reads the computed picture
// (depth_file.h) and removes the folder. The command may add text to the name of the picture. Error
// messages start with the name of the photo. Several threads may call the function at the same
// time.
Result<Samples> RunPictureCommand(const PictureCommand& command, const CommandInput& input);

// Computed pictures that are kept in temporary files, so that a photo can be opened several times.
// The name of a photo and the kind of the command identify a picture. Only one thread may use the
// object.
class KeptPictures {
 public:
  // Returns the kept picture of the photo, or runs the command (RunPictureCommand).
  Result<Samples> Of(const PictureCommand& command, const CommandInput& input);

 private:
  struct Kept {
    std::string path;  // Path of the map.
    Samples rest;      // Without the map.
  };

  TemporaryFolder folder_;
  std::map<std::pair<std::string, std::string>, Kept> kept_;
};

struct InputOptions {
  std::string path, depth, matte, right, coverage;
  bool ignores_coverage = false;  // True: the coverage and the mattes in the input cover nothing.
  PictureCommand depth_command = {"depth", "depth picture"}, matte_command = {"matte", "matte"};
  int seconds = 600;  // time limit of a command
  DepthOptions map = {};
  KeptPictures* kept = nullptr;  // Null: the commands run whenever the photo is opened.
};

// Options for processing the map. By default, the format of the input determines the processing.
struct MapOptions {
  bool repair = false, no_repair = false, fill = false;
};

// Returns true if a command computes the depth or the matte of photos, so that photos without depth
// are inputs.
inline bool RunsCommand(const InputOptions& options) {
  return !options.depth_command.line.empty() || !options.matte_command.line.empty();
}

// Adds the input and the options of its depth. If `several` is not null, the command takes several
// paths and stores the paths in `several` instead of in `options`.
void AddInputOptions(Command* command, InputOptions* options,
                     std::vector<std::string>* several = nullptr);
void AddCoverageOption(Command* command, InputOptions* options);
void AddRightOption(Command* command, InputOptions* options);
void AddMapOptions(Command* command, MapOptions* options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_OPTIONS_H_
