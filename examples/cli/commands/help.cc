// SPDX-License-Identifier: Apache-2.0
// starfocus help: prints help, the manual page or the completion script.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/documentation/documentation.h"
#include "examples/command_line/arguments.h"
#include "examples/command_line/parse.h"

namespace starfocus {
namespace {

struct HelpOptions {
  std::string command;
  bool manual = false, completion = false;
};

Error Run(const Program& program, const HelpOptions& options) {
  if (options.manual || options.completion) {
    const std::string text = options.manual ? ManualText(program) : CompletionText(program);
    std::printf("%s", text.c_str());
    return {};
  }
  const Command* command = options.command.empty() ? &program.main : nullptr;
  std::vector<std::string> names;
  for (const Command& one : program.commands) {
    names.push_back(one.name);
    if (one.name == options.command) command = &one;
  }
  if (command != nullptr) {
    std::printf("%s", HelpText(program, *command).c_str());
    return {};
  }
  const std::string nearest = NearestName(options.command, names);
  return Error::Usage("COMMAND",
                      nearest.empty()
                          ? "a subcommand that `" + std::string(program.main.name) + " help` lists"
                          : "a subcommand (the most similar is " + nearest + ")",
                      options.command);
}

}  // namespace

Command HelpCommand(const Program* program) {
  const auto options = std::make_shared<HelpOptions>();
  const std::string name = program->main.name;
  return {
      "help",
      "Print the help of the program or of a command",
      {
          {"COMMAND", "NAME", "Command to describe; default: the whole program", &options->command},
          {"--man", nullptr, "Print the manual page of all commands, in the format of man",
           &options->manual},
          {"--bash", nullptr, "Print the completion script for bash", &options->completion,
           Use::kOptional, "--man"},
      },
      [program, options] { return Run(*program, *options); },
      {name + " help --man > " + name + ".1", name + " help --bash > " + name + ".bash"}};
}

}  // namespace starfocus
