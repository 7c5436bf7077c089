// SPDX-License-Identifier: Apache-2.0
// The main function of a program.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_

#include <functional>
#include <string>

#include "platform/result.h"

namespace starfocus {

// The line of --version: name, version of the library and its SIMD target.
std::string VersionText(const std::string& name);

// Runs a program and returns its exit code. An error is printed as one line on stderr, "<name>:
// <line>". What could not be written to stdout is an error, and so is an exception. A closed pipe
// ends no program, and a signal that does leaves no temporary file.
int RunProgram(const char* name, const std::function<Error()>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
