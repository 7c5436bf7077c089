// SPDX-License-Identifier: Apache-2.0
// starfocus help: what the command line takes, for people, the manual and the shell.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/documentation/documentation.h"
#include "examples/command_line/arguments.h"

namespace starfocus {
namespace {

struct Options {
  std::string command;
  bool manual = false, completion = false;
};

Error Run(CLI::App* app, const Options& options) {
  if (options.manual || options.completion) {
    const std::string text = options.manual ? ManualText(app) : CompletionText(app);
    std::printf("%s", text.c_str());
    return "";
  }
  // Asked itself, the program would tell of the subcommand that runs.
  if (options.command.empty()) {
    std::printf(
        "%s",
        app->get_formatter()->make_help(app, app->get_name(), CLI::AppFormatMode::Normal).c_str());
    return "";
  }
  std::vector<std::string> names;
  for (const CLI::App* command : app->get_subcommands({})) {
    names.push_back(command->get_name());
    if (command->get_name() != options.command) continue;
    std::printf("%s", command->help(app->get_name()).c_str());
    return "";
  }
  const std::string nearest = NearestName(options.command, names);
  return Error::Usage("COMMAND",
                      nearest.empty() ? "a subcommand, of those `starfocus help` lists"
                                      : "a subcommand (the nearest is " + nearest + ")",
                      options.command);
}

}  // namespace

void AddHelpCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand("help", "What the program or a subcommand takes");
  command->add_option("COMMAND", options->command, "Subcommand to tell of")->type_name("NAME");
  CLI::Option* manual =
      command->add_flag("--man", options->manual, "Print the manual page instead, for man");
  command->add_flag("--bash", options->completion, "Print the completion script for bash instead")
      ->excludes(manual);
  command->callback(
      [app, options, action] { *action = [app, options] { return Run(app, *options); }; });
}

}  // namespace starfocus
