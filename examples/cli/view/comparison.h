// SPDX-License-Identifier: Apache-2.0
// Writes the page of `refocus --compare`, which shows a picture before and after refocusing, its
// depth, and the pixels in focus.
#ifndef STARFOCUS_EXAMPLES_CLI_VIEW_COMPARISON_H_
#define STARFOCUS_EXAMPLES_CLI_VIEW_COMPARISON_H_

#include <optional>
#include <string>

#include "examples/cli/engine/engine_run.h"
#include "examples/command_line/options.h"
#include "platform/file.h"
#include "platform/image.h"
#include "platform/result.h"

namespace starfocus {

// A picture that was refocused.
struct Refocused {
  std::string input;             // path of the input
  const EngineTask* task;        // light field and lens
  const Image* picture;          // result
  double widest = 1;             // f-stop of an aperture of radius 1
  std::optional<Pixel> at = {};  // pixel that determined the focus; nullopt: none
};

// Writes the page to the file `path`, completely or not at all. The picture must have the size of
// the centre view. `icc` is the colour profile of the pictures.
Error WriteComparison(const std::string& path, const Refocused& refocused, const Bytes& icc);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_VIEW_COMPARISON_H_
