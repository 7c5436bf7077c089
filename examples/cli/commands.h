// SPDX-License-Identifier: Apache-2.0
// The subcommands of `starfocus`. Each adds itself to the command line and, when chosen, sets
// `action`.
#ifndef STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
#define STARFOCUS_EXAMPLES_CLI_COMMANDS_H_

#include <CLI/CLI.hpp>
#include <functional>

#include "examples/command_line/error.h"

namespace starfocus {

using Action = std::function<Error()>;

void AddSceneCommand(CLI::App* app, Action* action);
void AddRefocusCommand(CLI::App* app, Action* action);
void AddDisparityCommand(CLI::App* app, Action* action);
void AddVideoCommand(CLI::App* app, Action* action);
void AddViewCommand(CLI::App* app, Action* action);
void AddCalibrateCommand(CLI::App* app, Action* action);
void AddCompareCommand(CLI::App* app, Action* action);
void AddImportCommand(CLI::App* app, Action* action);
void AddInfoCommand(CLI::App* app, Action* action);
void AddSheetCommand(CLI::App* app, Action* action);
void AddStressCommand(CLI::App* app, Action* action);
void AddAnalyzeCommand(CLI::App* app, Action* action);
// To be added last: it tells of the others.
void AddHelpCommand(CLI::App* app, Action* action);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_COMMANDS_H_
