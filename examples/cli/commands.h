// SPDX-License-Identifier: Apache-2.0
// The subcommands of `starfocus`.
#ifndef STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
#define STARFOCUS_EXAMPLES_CLI_COMMANDS_H_

#include "examples/command_line/command.h"

namespace starfocus {

Command RefocusCommand();
Command DisparityCommand();
Command VideoCommand();
Command ViewCommand();
Command ImportCommand();
Command InfoCommand();
// Prints the help, the manual page or the completion script of `program`.
Command HelpCommand(const Program* program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
