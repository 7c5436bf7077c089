// SPDX-License-Identifier: Apache-2.0
// The files that a command is about to write, looked at together before any work.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

struct Output {
  std::string option, path;
};

// What the same command reads.
struct Inputs {
  std::vector<std::string> folders = {};  // of light fields
  std::vector<std::string> files = {};    // others; an empty name is none
  std::vector<std::string> grids = {};    // folders in which every picture is taken for a view
};

// Whether each is a file of its own, and none of the inputs by any name or link.
Error CheckApart(const std::vector<Output>& outputs, const Inputs& inputs);

// Whether a folder of outputs is none of these folders of inputs, by any name or link: its files
// would mix with the views.
Error CheckFolderApart(const Output& output, const std::vector<std::string>& folders);

// Whether the folder is there and can be written into, or can be made.
Error CheckFolderOutput(const std::string& folder);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_OUTPUTS_H_
