// SPDX-License-Identifier: Apache-2.0
// starfocus: refocuses light fields from the command line.
#include "examples/cli/commands.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"

namespace {

using namespace starfocus;

Error Run(int argc, char** argv) {
  Program program;
  program.main = {
      "starfocus",
      "Refocus photographs after they were taken, from light fields or depth photos.",
      {},
      nullptr,
      {"starfocus refocus photo.jpg -o out.jpg", "starfocus view photo.jpg -o page.html"},
      "",
      {{"Pictures", {{"refocus"}, {"video"}}},
       {"Depth maps and light fields", {{"disparity"}, {"import"}}},
       {"Information", {{"info"}, {"view"}, {"help"}}},
       {"Options", {{"--help"}, {"--help-all"}, {"--version"}}}}};
  program.commands = {RefocusCommand(), DisparityCommand(), VideoCommand(),       ViewCommand(),
                      InfoCommand(),    ImportCommand(),    HelpCommand(&program)};
  program.lab_commands = {"analyze", "calibrate", "compare", "flicker", "scene", "sheet", "steps"};
  return RunCommandLine(program, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("starfocus", [&] { return Run(argc, argv); });
}
