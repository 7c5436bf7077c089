// SPDX-License-Identifier: Apache-2.0
// Parses a command line according to the tables of a program, and suggests corrections of a wrong
// command line. Only the source file includes CLI11, which takes seconds to compile.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_

#include <string>
#include <vector>

#include "examples/command_line/command.h"
#include "platform/result.h"

namespace starfocus {

// Sets the variables of the given options and runs the chosen subcommand or, without a subcommand,
// the program's own command. Prints help or the version if requested.
Error RunCommandLine(const Program& program, int argc, char** argv);

// Returns the first level of the help of a program, or of one of its subcommands.
std::string HelpText(const Program& program, const Command& command);

// Returns the name that is most similar to `typed`, or an empty string if no name is similar.
std::string NearestName(const std::string& typed, const std::vector<std::string>& names);

// Rejects values without separators, for example "--focus-at 160 120" if the option's type is X,Y.
// Values whose parts are separated by ',', ':' or 'x' must be one argument.
Error CheckSeparators(const std::vector<std::string>& arguments,
                      const std::vector<Option>& options);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
