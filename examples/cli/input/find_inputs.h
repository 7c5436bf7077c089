// SPDX-License-Identifier: Apache-2.0
// Finds the light fields and photos in a folder.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_FIND_INPUTS_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_FIND_INPUTS_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus {

// A file or folder that is not an input, and the reason.
struct SkippedPath {
  std::string path, reason;
};

struct FoundInputs {
  std::vector<std::string> paths;    // in natural order (natural_order.h)
  std::vector<SkippedPath> skipped;  // in natural order of the paths; without hidden files
};

// Returns the inputs that `path` stands for. If `path` is a folder but not a light field, these are
// the photos and light fields in the folder, without the folder `out`. Otherwise the only input is
// `path`. A PNG, WebP or PPM file is a photo if it has a depth picture next to it, or if
// `has_command` is true, which means that a command computes the depth or the matte of photos. A
// row of pictures with numbers in their names is a light field unless one of the pictures
// has depth or `has_command` is true. If a folder contains several stereo pairs in the folders
// `left` and `right`, the inputs are the left pictures. Returns an error if the folder contains no
// input.
Result<FoundInputs> FindInputs(const std::string& path, bool has_command, const std::string& out);

// Returns the name of an input without folders, and without extension if the input is a file.
// Output pictures get this name.
std::string NameOfInput(const std::string& input);

// Prints the skipped paths to stderr.
void TellSkipped(const std::vector<SkippedPath>& skipped);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_FIND_INPUTS_H_
