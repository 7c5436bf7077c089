// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "examples/command_line/arguments.h"
#include "examples/command_line/help.h"
#include "examples/command_line/program.h"
#include "platform/file.h"
#include "platform/helper/helper.h"

namespace starfocus {
namespace {

// Returns a callback that parses the value of an option and sets `wrong` if the value is invalid.
CLI::callback_t ReaderOf(const Option& option, Error* wrong) {
  return [read = option.target.read, name = NamesOf(option).back(),
          wrong](const CLI::results_t& texts) {
    const std::string expected = read(texts[0]);
    if (!expected.empty()) {
      *wrong = Error::Usage(name, expected, "'" + texts[0].substr(0, 60) + "'");
    }
    return expected.empty();
  };
}

void AddOption(const Option& option, Error* wrong, CLI::App* app) {
  const Target& target = option.target;
  CLI::Option* added = target.flag != nullptr   ? app->add_flag(option.names, *target.flag)
                       : target.text != nullptr ? app->add_option(option.names, *target.text)
                       : target.read ? app->add_option(option.names, ReaderOf(option, wrong))
                                     : app->add_option(option.names, *target.texts);
  added->description(option.help);
  if (option.type != nullptr) added->type_name(option.type);
  added->required(option.use == Use::kRequired);
  if (option.use == Use::kCommaSeparated) added->delimiter(',')->allow_extra_args(false);
  added->default_str(DefaultOf(option));
  if (option.excludes != nullptr) added->excludes(app->get_option(option.excludes));
}

void AddCommandOptions(const Program& program, const Command& command, Error* wrong,
                       CLI::App* app) {
  app->set_help_flag(kHelpOption.names, kHelpOption.help);
  if (!program.main.basics.empty()) {
    app->set_help_all_flag(kHelpAllOption.names, kHelpAllOption.help);
  }
  for (const Option& option : command.options) AddOption(option, wrong, app);
}

// Returns the text that the help shows below the options: notes, followed by examples.
std::string FooterOf(const Command& command) {
  std::string text = command.footer;
  if (command.examples.empty()) return text;
  text += text.empty() ? "Examples:" : "\n\nExamples:";
  for (const std::string& example : command.examples) text += "\n  " + example;
  return text;
}

// Converts a program to CLI11's representation. `wrong` receives the error of an invalid value.
void Translate(const Program& program, Error* wrong, CLI::App* app) {
  app->name(program.main.name);
  app->description(program.main.help);
  AddCommandOptions(program, program.main, wrong, app);
  app->set_version_flag(kVersionOption.names, VersionText(program.main.name), kVersionOption.help);
  // If a subcommand were required, CLI11 would report its absence instead of a wrong argument.
  if (!program.commands.empty()) app->require_subcommand(0, 1);
  for (const Command& command : program.commands) {
    CLI::App* added = app->add_subcommand(command.name, command.help);
    AddCommandOptions(program, command, wrong, added);
    added->footer(FooterOf(command));
  }
  const std::string footer = FooterOf(program.main);
  app->footer(footer + (footer.empty() ? "" : "\n\n") + kExitCodes);
}

// Rejects empty values. CLI11 treats an empty value as missing if the default is also empty.
Error CheckValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty()) return Error::Usage(option->get_name(), "a value", "''");
    }
  }
  for (const CLI::App* command : app.get_subcommands()) {
    if (Error error = CheckValues(*command)) return error;
  }
  return {};
}

std::string ValueType(const CLI::Option& option) {
  return option.get_expected_max() == 0 ? "" : option.get_type_name();
}

// Returns the chosen subcommand, or the program itself.
CLI::App* Chosen(CLI::App* app) {
  const std::vector<CLI::App*> chosen = app->get_subcommands();
  return chosen.empty() ? app : chosen[0];
}

std::vector<std::string> OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

// Formats, for example, "an option of refocus (the most similar is --focus)".
std::string WithNearest(const std::string& kind, const std::string& typed,
                        const std::vector<std::string>& names, const std::string& list) {
  const std::string nearest = NearestName(typed, names);
  return kind + (nearest.empty() ? " (`" + list + "` lists them)"
                                 : " (the most similar is " + nearest + ")");
}

// Returns the error for an argument that matches no option and no positional argument.
Error Unexpected(CLI::App* app, const std::string& argument) {
  CLI::App* command = Chosen(app);
  const bool all = command == app;
  const std::string& name = command->get_name();
  if (argument.size() > 1 && argument[0] == '-') {
    const std::string option = argument.substr(0, argument.find('='));
    const std::string list = app->get_name() + (all ? "" : " " + name) + " --help";
    return Error::Usage(option,
                        WithNearest("an option of " + name, option, OptionNames(*command), list),
                        "an unknown option");
  }
  std::vector<std::string> commands;
  for (const CLI::App* one : app->get_subcommands({})) commands.push_back(one->get_name());
  if (all && !commands.empty()) {
    return Error::Usage("command line",
                        WithNearest("a subcommand", argument, commands, app->get_name() + " help"),
                        "'" + argument + "'");
  }
  return Error::Usage("command line", "no more arguments for " + name, "'" + argument + "'");
}

// Returns the error for an unknown, missing or extra argument. If `value` contains the error of an
// invalid value, returns this error unless another argument is unexpected.
Error WrongLine(CLI::App* app, const CLI::ParseError& wrong, const Error& value) {
  const std::vector<std::string> others = app->remaining(true);
  const auto is_option = [](const std::string& text) { return text.size() > 1 && text[0] == '-'; };
  const bool no_command = Chosen(app) == app && !app->get_subcommands({}).empty();
  if (no_command && !others.empty()) return Unexpected(app, others[0]);
  const auto option = std::find_if(others.begin(), others.end(), is_option);
  if (option != others.end()) return Unexpected(app, *option);
  if (!others.empty()) return Unexpected(app, others[0]);
  if (value) return value;
  const std::string text = wrong.what();
  for (const CLI::Option* its : Chosen(app)->get_options()) {
    const std::string name = its->get_name();
    const bool lacks_value = text.rfind(name + ": ", 0) == 0 && !ValueType(*its).empty();
    if (lacks_value) return Error::Usage(name, "a value (" + ValueType(*its) + ")", "none");
    if (!its->get_required() || its->count() > 0) continue;
    if (text.rfind(name + " is required", 0) != 0) continue;
    return Error::Usage(
        name, its->get_positional() ? ValueType(*its) : name + " " + ValueType(*its), "none");
  }
  const size_t excludes = text.find(" excludes ");
  if (excludes != std::string::npos) {
    return Error::Usage(text.substr(0, excludes),
                        "either " + text.substr(0, excludes) + " or " + text.substr(excludes + 10),
                        "both");
  }
  return Error::Usage("command line", "arguments that `" + app->get_name() + " --help` lists",
                      text);
}

// Returns the subcommand called `name`, or the program's own command if no subcommand has this
// name.
const Command& CommandOf(const Program& program, const std::string& name) {
  for (const Command& command : program.commands) {
    if (command.name == name) return command;
  }
  return program.main;
}

// Returns the help of all options of a command, or of the program and all its commands.
std::string AllHelpText(const Program& program, const Command& command) {
  CLI::App app;
  Error unused;
  Translate(program, &unused, &app);
  const std::string name = app.get_name();
  if (&command != &program.main) return app.get_subcommand(command.name)->help(name);
  std::string text = app.help();
  for (const CLI::App* one : app.get_subcommands({})) text += "\n" + one->help(name);
  return text;
}

}  // namespace

Error RunCommandLine(const Program& program, int argc, char** argv) {
  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  const std::string first = arguments.empty() ? "" : arguments[0];
  for (const std::string& name : program.lab_commands) {
    if (first == name) {
      return Error::Usage("command line", "`starfocus-lab " + name + "`", "'" + name + "'");
    }
  }
  if (Error error = CheckSeparators(arguments, CommandOf(program, first).options)) return error;
  if (arguments.empty() && !program.main.basics.empty()) {
    // The first lines of the help take the place of an error line.
    std::printf("%s", FirstLinesOfHelp(program).c_str());
    return Error(ErrorKind::kUsage, "");
  }
  CLI::App app;
  Error wrong_value;
  Translate(program, &wrong_value, &app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::printf("%s", HelpText(program, CommandOf(program, Chosen(&app)->get_name())).c_str());
    return {};
  } catch (const CLI::CallForAllHelp&) {
    std::printf("%s", AllHelpText(program, CommandOf(program, Chosen(&app)->get_name())).c_str());
    return {};
  } catch (const CLI::CallForVersion& version) {
    std::printf("%s\n", version.what());
    return {};
  } catch (const CLI::ParseError& wrong) {
    return WrongLine(&app, wrong, wrong_value);
  }
  const Command& chosen = CommandOf(program, Chosen(&app)->get_name());
  if (Error error = CheckValues(app)) return error;
  if (!program.commands.empty() && &chosen == &program.main) {
    return Error::Usage("command line", "a subcommand that `" + app.get_name() + " help` lists",
                        "none");
  }
  if (!chosen.starts_programs || !chosen.starts_programs()) ConfineProgram();
  try {
    return chosen.run();
  } catch (const std::bad_alloc&) {
    return OutOfMemory(chosen.name, "finish");
  }
}

std::string HelpText(const Program& program, const Command& command) {
  if (command.basics.empty()) return AllHelpText(program, command);
  return BasicHelp(program, command);
}

}  // namespace starfocus
