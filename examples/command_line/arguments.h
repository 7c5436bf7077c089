// SPDX-License-Identifier: Apache-2.0
// What a command line that is wrong was meant to be: the nearest name, and values that lack the
// separator between their parts.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_

#include <string>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/result.h"

namespace starfocus {

// The name that is nearest to what was typed; empty where none is near.
std::string NearestName(const std::string& typed, const std::vector<std::string>& names);

// Refuses "--focus-at 160 120" where the option's type is X,Y: the values of an option whose parts
// have the separators ',', ':' or 'x' between them are one argument.
Error CheckSeparators(const std::vector<std::string>& arguments,
                      const std::vector<Option>& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_ARGUMENTS_H_
