// SPDX-License-Identifier: Apache-2.0
#include "examples/command_line/program.h"

#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

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

}  // namespace

const char kExitCodes[] =
    "Exit codes: 0 for success, 1 when a file or the work failed, 2 when the command line is\n"
    "wrong, 70 for an error in the program itself.\n";

std::string VersionText(const std::string& name) {
  return name + " " + sf_version() + " (" + sf_simd_target() + ")";
}

bool ParseCommandLine(CLI::App* app, int argc, char** argv, Error* error) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::printf("%s", app->help().c_str());
    return false;
  } catch (const CLI::CallForVersion& version) {
    std::printf("%s\n", version.what());
    return false;
  } catch (const CLI::ParseError& wrong) {
    // CLI11 tells what it missed or could not place in its own words.
    *error =
        Error::Usage("command line", "what `" + app->get_name() + " --help` lists", wrong.what());
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
