// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <new>
#include <string>
#include <vector>

#include "examples/command_line/command.h"
#include "examples/command_line/program.h"
#include "platform/file.h"
#include "platform/helper/helper.h"

namespace starfocus {

namespace {

// Returns the edit distance of `a` and `b` (optimal string alignment): the number of letters to
// insert, remove, replace, or swap with the next letter.
size_t Distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<size_t>> least(a.size() + 1, std::vector<size_t>(b.size() + 1));
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t k = 0; k <= b.size(); ++k) {
      size_t& here = least[i][k];
      if (i == 0 || k == 0) {
        here = i + k;
        continue;
      }
      const bool same = a[i - 1] == b[k - 1];
      here = std::min(
          {least[i - 1][k] + 1, least[i][k - 1] + 1, least[i - 1][k - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1];
      if (swapped) here = std::min(here, least[i - 2][k - 2] + 1);
    }
  }
  return least[a.size()][b.size()];
}

std::string WithoutDashes(const std::string& name) {
  return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

// Describes the parts of an option's type: the separator between the parts, and the number of
// parts. The type "X,Y" has two parts, and "D0:D1:N" has three. The separator is 0 if values of the
// type are not divided into parts.
struct Parts {
  char separator = 0;
  size_t count = 1;
};

bool IsPartName(char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

Parts PartsOf(const std::string& type) {
  Parts parts;
  // Values of a type such as "D,U ..." may be repeated.
  const std::string text = type.substr(0, type.find(' '));
  for (size_t i = 0; i < text.size(); ++i) {
    if (IsPartName(text[i])) continue;
    const bool inside = i > 0 && i + 1 < text.size() && IsPartName(text[i + 1]);
    const bool known = text[i] == ',' || text[i] == ':' || text[i] == 'x';
    if (!inside || !known || (parts.separator != 0 && parts.separator != text[i])) return {};
    parts.separator = text[i];
    ++parts.count;
  }
  return parts;
}

// Appends all numbers in `text` to `numbers`. `separator` or spaces separate the numbers. Returns
// false if the text contains anything else.
bool AddNumbers(const std::string& text, char separator, std::vector<std::string>* numbers) {
  const std::string between = std::string(" ") + separator;
  for (size_t begin = text.find_first_not_of(between); begin < text.size();) {
    const size_t end = std::min(text.find_first_of(between, begin), text.size());
    const std::string number = text.substr(begin, end - begin);
    if (number.find_first_not_of("0123456789+-.") != std::string::npos ||
        number.find_first_of("0123456789") == std::string::npos) {
      return false;
    }
    numbers->push_back(number);
    begin = text.find_first_not_of(between, end);
  }
  return true;
}

// Returns the complete value that starts with `first` and continues in the arguments from index
// `next`. Returns an empty string if `first` is already complete, or if separators cannot complete
// the value.
std::string Joined(const std::string& first, const std::vector<std::string>& arguments, size_t next,
                   const Parts& parts, std::string* found) {
  std::vector<std::string> numbers;
  *found = first;
  if (!AddNumbers(first, parts.separator, &numbers) || numbers.empty()) return "";
  const bool spaces = first.find(' ') != std::string::npos;
  if (numbers.size() >= parts.count && !spaces) return "";
  for (; numbers.size() < parts.count && next < arguments.size(); ++next) {
    if (!AddNumbers(arguments[next], parts.separator, &numbers)) return "";
    *found += " " + arguments[next];
  }
  if (numbers.size() != parts.count) return "";
  std::string joined = numbers[0];
  for (size_t k = 1; k < numbers.size(); ++k) joined += parts.separator + numbers[k];
  return joined;
}

Error WrongParts(const std::string& name, const std::string& type, const Parts& parts,
                 const std::string& joined, const std::string& found) {
  std::string fault = " (a comma is missing)";
  if (parts.separator == ':') fault = " (a colon is missing)";
  if (parts.separator == 'x') fault = " (an x is missing)";
  if (found.find(parts.separator) != std::string::npos) fault = " (with spaces)";
  return Error::Usage(
      name, type.substr(0, type.find(' ')) + " without spaces, as in " + name + " " + joined,
      "'" + found + "'" + fault);
}

}  // namespace

std::string NearestName(const std::string& typed, const std::vector<std::string>& names) {
  const std::string wanted = WithoutDashes(typed);
  const size_t far = std::max<size_t>(wanted.size() < 4 ? 2 : 3, wanted.size() / 3 + 1);
  size_t least = far;
  std::string nearest;
  for (const std::string& name : names) {
    const std::string its = WithoutDashes(name);
    // Accept a name even if the user has typed only the start of the name.
    const bool beginning = wanted.size() >= 3 && its.compare(0, wanted.size(), wanted) == 0;
    const size_t distance = beginning ? 1 : Distance(wanted, its);
    if (distance >= least || distance >= its.size()) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

Error CheckSeparators(const std::vector<std::string>& arguments,
                      const std::vector<Option>& options) {
  for (size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const size_t equals = arguments[i].find('=');
    const std::string name = arguments[i].substr(0, equals);
    for (const Option& option : options) {
      if (option.type == nullptr) continue;
      const Parts parts = PartsOf(option.type);
      const std::vector<std::string> names = NamesOf(option);
      if (parts.separator == 0 || std::find(names.begin(), names.end(), name) == names.end()) {
        continue;
      }
      const bool inside = equals != std::string::npos;
      if (!inside && i + 1 == arguments.size()) continue;
      const std::string value = inside ? arguments[i].substr(equals + 1) : arguments[i + 1];
      std::string found;
      const std::string joined = Joined(value, arguments, i + (inside ? 1 : 2), parts, &found);
      if (joined.empty()) continue;
      return WrongParts(name, option.type, parts, joined, found);
    }
  }
  return {};
}

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
