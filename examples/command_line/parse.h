// SPDX-License-Identifier: Apache-2.0
// Parses a command line according to the tables of a program. Only the source file includes CLI11,
// which takes seconds to compile.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_

#include <string>

#include "examples/command_line/command.h"
#include "platform/result.h"

namespace starfocus {

// Sets the variables of the given options and runs the chosen subcommand or, without a subcommand,
// the program's own command. Prints help or the version if requested.
Error RunCommandLine(const Program& program, int argc, char** argv);

// Returns the first level of the help of a program, or of one of its subcommands.
std::string HelpText(const Program& program, const Command& command);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
