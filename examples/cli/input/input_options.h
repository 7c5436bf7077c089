// SPDX-License-Identifier: Apache-2.0
// Options of commands that open light fields and photos.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_OPTIONS_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_OPTIONS_H_

#include <string>
#include <vector>

#include "examples/cli/input/picture_command.h"
#include "examples/command_line/command.h"
#include "platform/readers/depth_options.h"

namespace starfocus {

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

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_INPUT_OPTIONS_H_
