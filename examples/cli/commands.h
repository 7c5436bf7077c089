// SPDX-License-Identifier: Apache-2.0
// The subcommands of `starfocus`.
#ifndef STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
#define STARFOCUS_EXAMPLES_CLI_COMMANDS_H_

#include "examples/command_line/command.h"

namespace starfocus {

Command SceneCommand();
Command RefocusCommand();
Command DisparityCommand();
Command VideoCommand();
Command ViewCommand();
Command CalibrateCommand();
Command CompareCommand();
Command ImportCommand();
Command InfoCommand();
Command SheetCommand();
Command StressCommand();
Command AnalyzeCommand();
// Prints the help, the manual page or the completions of `program`.
Command HelpCommand(const Program* program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
