// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/program.h"

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "examples/command_line/arguments.h"
#include "platform/file.h"
#include "platform/temporary_file.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// What was printed reaches its file or pipe, or the reason why not is told.
Error CheckPrinted() {
  const bool failed = std::ferror(stdout) != 0;
  errno = 0;
  if (std::fflush(stdout) == 0 && !failed) return {};
  const int reason = errno != 0 ? errno : EIO;
  return Expected("standard output", "room for what is printed",
                  std::generic_category().message(reason));
}

int Report(const char* name, const Error& error) {
  if (!error.empty()) std::fprintf(stderr, "%s: %s\n", name, error.line().c_str());
  return static_cast<int>(error.code());
}

// CLI11 takes an empty value for none at all where the default is empty too.
Error CheckValues(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty()) return Error::Usage(option->get_name(), "a value", "''");
    }
  }
  for (const CLI::App* command : app.get_subcommands()) {
    Error error = CheckValues(*command);
    if (!error.empty()) return error;
  }
  return {};
}

std::string ValueType(const CLI::Option& option) {
  return option.get_expected_max() == 0 ? "" : option.get_type_name();
}

// The subcommand that the command line names, else the program itself.
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

std::vector<ValueOption> ValueOptions(const CLI::App& command) {
  std::vector<ValueOption> options;
  for (const CLI::Option* option : command.get_options()) {
    ValueOption its = {{}, ValueType(*option)};
    for (const std::string& name : option->get_lnames()) its.names.push_back("--" + name);
    options.push_back(its);
  }
  return options;
}

// "an option of refocus (the nearest is --focus)"
std::string WithNearest(const std::string& kind, const std::string& typed,
                        const std::vector<std::string>& names, const std::string& list) {
  const std::string nearest = NearestName(typed, names);
  return kind +
         (nearest.empty() ? " (`" + list + "` lists them)" : " (the nearest is " + nearest + ")");
}

// An argument that neither an option nor a positional one takes.
Error Unexpected(CLI::App* app, const std::string& argument) {
  CLI::App* command = Chosen(app);
  const bool all = command == app;
  const std::string& name = command->get_name();
  if (argument.size() > 1 && argument[0] == '-') {
    const std::string option = argument.substr(0, argument.find('='));
    const std::string list = app->get_name() + (all ? "" : " " + name) + " --help";
    return Error::Usage(option,
                        WithNearest("an option of " + name, option, OptionNames(*command), list),
                        "an unknown one");
  }
  std::vector<std::string> commands;
  for (const CLI::App* one : app->get_subcommands({})) commands.push_back(one->get_name());
  if (all && !commands.empty()) {
    return Error::Usage("command line",
                        WithNearest("a subcommand", argument, commands, app->get_name() + " help"),
                        "'" + argument + "'");
  }
  return Error::Usage("command line", "no other argument of " + name, "'" + argument + "'");
}

// Names the argument that is unknown, missing or in excess.
Error WrongLine(CLI::App* app, const CLI::ParseError& wrong) {
  const std::vector<std::string> others = app->remaining(true);
  const auto is_option = [](const std::string& text) { return text.size() > 1 && text[0] == '-'; };
  const bool no_command = Chosen(app) == app && !app->get_subcommands({}).empty();
  if (no_command && !others.empty()) return Unexpected(app, others[0]);
  const auto option = std::find_if(others.begin(), others.end(), is_option);
  if (option != others.end()) return Unexpected(app, *option);
  if (!others.empty()) return Unexpected(app, others[0]);
  const std::string text = wrong.what();
  for (const CLI::Option* its : Chosen(app)->get_options()) {
    const std::string name = its->get_name();
    const bool lacks_value = text.rfind(name + ": ", 0) == 0 && !ValueType(*its).empty();
    if (lacks_value) return Error::Usage(name, "a value " + ValueType(*its), "none");
    if (!its->get_required() || its->count() > 0) continue;
    if (text.rfind(name + " is required", 0) != 0) continue;
    return Error::Usage(
        name, its->get_positional() ? ValueType(*its) : name + " " + ValueType(*its), "none");
  }
  const size_t excludes = text.find(" excludes ");
  if (excludes != std::string::npos) {
    return Error::Usage(text.substr(0, excludes), "no " + text.substr(excludes + 10) + " beside it",
                        "both");
  }
  return Error::Usage("command line", "what `" + app->get_name() + " --help` lists", text);
}

// The options whose values the arguments may have: those of the subcommand that is named first.
Error CheckValueParts(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  for (const CLI::App* one : app.get_subcommands({})) {
    if (!arguments.empty() && one->get_name() == arguments[0]) command = one;
  }
  return CheckSeparators(arguments, ValueOptions(*command));
}

}  // namespace

const char kExitCodes[] =
    "Exit codes: 0 for success, 1 when a file or the work failed, 2 when the command line is\n"
    "wrong, 70 for an error in the program itself.\n";

std::string VersionText(const std::string& name) {
  return name + " " + sf_version() + " (" + sf_simd_target() + ")";
}

bool ParseCommandLine(CLI::App* app, int argc, char** argv, Error* error) {
  *error = CheckValueParts(*app, {argv + std::min(argc, 1), argv + argc});
  if (!error->empty()) return false;
  try {
    app->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::printf("%s", app->help().c_str());
    return false;
  } catch (const CLI::CallForVersion& version) {
    std::printf("%s\n", version.what());
    return false;
  } catch (const CLI::ParseError& wrong) {
    *error = WrongLine(app, wrong);
    return false;
  }
  *error = CheckValues(*app);
  return error->empty();
}

int RunProgram(const char* name, const std::function<Error()>& run) {
  signal(SIGPIPE, SIG_IGN);
  TemporaryFile::RemoveOnSignals();
  try {
    Error error = run();
    if (error.empty()) error = CheckPrinted();
    return Report(name, error);
  } catch (const std::bad_alloc&) {
    // Nothing here needs memory.
    std::fprintf(stderr,
                 "%s: memory: expected enough to finish, found too little (out of memory)\n", name);
    return static_cast<int>(ExitCode::kFailed);
  } catch (const std::exception& exception) {
    return Report(name, Error::Internal("program", "no internal error", exception.what()));
  }
}

}  // namespace starfocus
