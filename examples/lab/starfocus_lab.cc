// SPDX-License-Identifier: Apache-2.0
// starfocus-lab: a program for developers that ray-traces scenes, compares pictures, and measures
// and tests the engine.
#include "examples/cli/commands.h"
#include "examples/command_line/parse.h"
#include "examples/command_line/program.h"
#include "examples/lab/commands.h"

namespace {

using namespace starfocus;

Error Run(int argc, char** argv) {
  Program program;
  program.main = {"starfocus-lab",
                  "Render scenes, compare pictures, and measure and test the engine of starfocus.",
                  {},
                  nullptr,
                  {},
                  "",
                  {{"Pictures",
                    {{"scene"},
                     {"compare", "Print how much two pictures differ"},
                     {"flicker", "Measure how much the pictures of a clip flicker"},
                     {"sheet"},
                     {"steps", "Draw the intermediate data of refocusing"}}},
                   {"Engine",
                    {{"analyze", "Compute the paper's filter analysis"},
                     {"calibrate", "Measure the coefficients of the timing model"},
                     {"help"}}},
                   {"Options", {{"--help"}, {"--help-all"}, {"--version"}}}}};
  program.commands = {SceneCommand(), CompareCommand(),     FlickerCommand(),
                      SheetCommand(), AnalyzeCommand(),     CalibrateCommand(),
                      StepsCommand(), HelpCommand(&program)};
  return RunCommandLine(program, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return RunProgram("starfocus-lab", [&] { return Run(argc, argv); });
}
