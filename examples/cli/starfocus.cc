// SPDX-License-Identifier: Apache-2.0
// starfocus: refocuses light fields from the command line.
#include <new>

#include "examples/cli/commands.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"
#include "platform/file.h"

namespace {

using namespace starfocus;

Error Run(int argc, char** argv) {
  Program program;
  program.main = {
      "starfocus",
      "Refocuses a photograph after it was taken: from a light field and its disparity map.",
      {},
      nullptr};
  program.commands = {SceneCommand(),       RefocusCommand(),   DisparityCommand(), VideoCommand(),
                      ViewCommand(),        CalibrateCommand(), CompareCommand(),   InfoCommand(),
                      ImportCommand(),      SheetCommand(),     AnalyzeCommand(),   StressCommand(),
                      HelpCommand(&program)};
  Error error;
  const Command* command = ParseCommandLine(program, argc, argv, &error);
  if (command == nullptr) return error;
  try {
    return command->run();
  } catch (const std::bad_alloc&) {
    return OutOfMemory(command->name, "finish");
  }
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("starfocus", [&] { return Run(argc, argv); });
}
