// SPDX-License-Identifier: Apache-2.0
// Suggests corrections of a wrong command line: the most similar name, and separators that are
// missing between the parts of a value.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_

#include <string>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/result.h"

namespace starfocus {

// Returns the name that is most similar to `typed`, or an empty string if no name is similar.
std::string NearestName(const std::string& typed, const std::vector<std::string>& names);

// Rejects values without separators, for example "--focus-at 160 120" if the option's type is X,Y.
// Values whose parts are separated by ',', ':' or 'x' must be one argument.
Error CheckSeparators(const std::vector<std::string>& arguments,
                      const std::vector<Option>& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_
