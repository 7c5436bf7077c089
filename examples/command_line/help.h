// SPDX-License-Identifier: Apache-2.0
// Formats the first level of the help (--help), which contains the options that most users need.
// The second level (--help-all) contains all options.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_HELP_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_HELP_H_

#include <string>

#include "examples/command_line/command.h"

namespace starfocus {

// Returns the first level of the help of a program or of one of its commands.
std::string BasicHelp(const Program& program, const Command& command);

// Returns the first lines of the help of a program, up to the list of its commands.
std::string FirstLinesOfHelp(const Program& program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_HELP_H_
