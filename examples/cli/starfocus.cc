// SPDX-License-Identifier: Apache-2.0
// starfocus: refocuses light fields from the command line.
#include <new>
#include <string>

#include "examples/cli/commands.h"
#include "examples/command_line/program.h"
#include "platform/file.h"

namespace {

using namespace starfocus;

Error Run(int argc, char** argv) {
  CLI::App app(
      "Refocuses a photograph after it was taken: from a light field and its "
      "disparity map.",
      "starfocus");
  app.require_subcommand(0, 1);  // none is said below: here it would hide what stands in its place
  app.set_version_flag("--version", VersionText("starfocus"), "Print the version and end");
  Action action;
  AddSceneCommand(&app, &action);
  AddRefocusCommand(&app, &action);
  AddDisparityCommand(&app, &action);
  AddVideoCommand(&app, &action);
  AddCalibrateCommand(&app, &action);
  AddCompareCommand(&app, &action);
  AddInfoCommand(&app, &action);
  AddSheetCommand(&app, &action);
  AddAnalyzeCommand(&app, &action);
  AddStressCommand(&app, &action);
  AddHelpCommand(&app, &action);
  app.footer(kExitCodes);  // commands made after it would say so, too
  Error error;
  if (!ParseCommandLine(&app, argc, argv, &error)) return error;
  if (app.get_subcommands().empty()) {
    return Error::Usage("command line", "a subcommand, of those `starfocus help` lists", "none");
  }
  try {
    return action();
  } catch (const std::bad_alloc&) {
    return OutOfMemory(app.get_subcommands()[0]->get_name(), "finish");
  }
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("starfocus", [&] { return Run(argc, argv); });
}
