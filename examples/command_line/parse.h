// SPDX-License-Identifier: Apache-2.0
// Reads a command line by a program's tables of options. Only the source file includes CLI11, which
// takes seconds to compile.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_

#include <string>

#include "examples/command_line/command.h"
#include "platform/result.h"

namespace starfocus {

// Sets the variables of the options that the command line has and runs the command that it names:
// a subcommand, or the program's own. Prints help or the version where it asks for them.
Error RunCommandLine(const Program& program, int argc, char** argv);

// The help of a program, or of one of its subcommands.
std::string HelpText(const Program& program, const Command& command);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PARSE_H_
