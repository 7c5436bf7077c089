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
      "Refocus photographs after they were taken, from a light field and its disparity map.",
      {},
      nullptr};
  program.commands = {RefocusCommand(), DisparityCommand(), VideoCommand(),       ViewCommand(),
                      InfoCommand(),    ImportCommand(),    HelpCommand(&program)};
  program.lab_commands = {"analyze", "calibrate", "compare", "scene", "sheet", "steps", "stress"};
  return RunCommandLine(program, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("starfocus", [&] { return Run(argc, argv); });
}
