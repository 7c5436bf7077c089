// SPDX-License-Identifier: Apache-2.0
// Options for the shape of an aperture.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_

#include <string>

#include "examples/command_line/command.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

struct ShapeOptions {
  std::string shape = "fall-off";  // name of the shape as typed
  double theta = 0.26, cats_eye = 0;
};

void AddShapeOptions(Command* command, ShapeOptions* options);

// Returns a lens with the shape of the options; other fields have their defaults.
Result<starfocus::Params> ParseShape(const ShapeOptions& options);

// Returns a suffix for file names that identifies the shape, or "" for the default shape.
std::string ShapeSuffix(const ShapeOptions& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_SHAPE_H_
