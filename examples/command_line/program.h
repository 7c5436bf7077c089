// SPDX-License-Identifier: Apache-2.0
// The main function of a program.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "examples/command_line/error.h"

namespace starfocus {

// The line of --version: name, version of the library and its SIMD target.
std::string VersionText(const std::string& name);

// The last lines of a program's help.
extern const char kExitCodes[];

// Reads the command line. True when it asks for work; where it asks for help or the version, they
// are printed, and what it must not say is *error.
bool ParseCommandLine(CLI::App* app, int argc, char** argv, Error* error);

// Runs a program and returns its exit code. An error is printed as one line on stderr, "<name>:
// <line>". What could not be written to stdout is an error, and so is an exception. A closed pipe
// ends no program, and a signal that does leaves no temporary file.
int RunProgram(const char* name, const std::function<Error()>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
