// starfocus: refocuses star-shaped light fields from the command line.
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "examples/cli/commands.h"
#include "platform/file.h"

namespace {

int Fail(const std::string& line) {
  std::fprintf(stderr, "starfocus: %s\n", line.c_str());
  return 1;
}

// CLI11 tells what it missed or could not place in its own words.
int FailParse(const CLI::ParseError& error) {
  return Fail(starfocus::Expected("command line", "what `starfocus --help` lists", error.what()));
}

// CLI11 takes an empty value for none at all where the default is empty too.
std::string FindEmptyValue(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty()) return starfocus::Expected(option->get_name(), "a value", "''");
    }
  }
  return "";
}

int Run(int argc, char** argv) {
  CLI::App app(
      "Refocuses a photograph after it was taken: from a star-shaped light field and its "
      "disparity map.",
      "starfocus");
  app.require_subcommand(0, 1);  // none is said below: here it would hide what stands in its place
  starfocus::Action action;
  starfocus::AddSceneCommand(&app, &action);
  starfocus::AddRefocusCommand(&app, &action);
  starfocus::AddVideoCommand(&app, &action);
  starfocus::AddCalibrateCommand(&app, &action);
  starfocus::AddCompareCommand(&app, &action);
  starfocus::AddInfoCommand(&app, &action);
  starfocus::AddSheetCommand(&app, &action);
  starfocus::AddAnalyzeCommand(&app, &action);
  starfocus::AddStressCommand(&app, &action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : FailParse(error);
  }
  if (app.get_subcommands().empty()) return Fail("command line: expected a subcommand, found none");
  std::string error = FindEmptyValue(*app.get_subcommands()[0]);
  if (error.empty()) error = action();
  return error.empty() ? 0 : Fail(error);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return Run(argc, argv);
  } catch (const std::bad_alloc&) {
    return Fail("memory: expected enough for these pictures, found too little");
  } catch (const std::exception& error) {
    return Fail(starfocus::Expected("starfocus", "no internal failure", error.what()));
  }
}
