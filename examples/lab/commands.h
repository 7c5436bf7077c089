// SPDX-License-Identifier: Apache-2.0
// The subcommands of `starfocus-lab`, except `help`.
#ifndef STARFOCUS_EXAMPLES_LAB_COMMANDS_H_
#define STARFOCUS_EXAMPLES_LAB_COMMANDS_H_

#include "examples/command_line/command.h"

namespace starfocus {

Command SceneCommand();
Command CompareCommand();
Command FlickerCommand();
Command SheetCommand();
Command AnalyzeCommand();
Command CalibrateCommand();
Command StepsCommand();

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_LAB_COMMANDS_H_
