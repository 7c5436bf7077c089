// SPDX-License-Identifier: Apache-2.0
// Options for the shape of an aperture.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_

#include <string>

#include "examples/command_line/command.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

struct ShapeOptions {
  std::string shape = "fall-off";  // as typed
  double theta = 0.26, cats_eye = 0;
};

void AddShapeOptions(Command* command, ShapeOptions* options);

// The lens of the shape that the options ask for, and defaults.
Result<starfocus_lens> ParseShape(const ShapeOptions& options);

// What tells the shape from the default one in a file's name, "" for that.
std::string ShapeSuffix(const ShapeOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_
