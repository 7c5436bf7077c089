// SPDX-License-Identifier: Apache-2.0
// Code that the main functions of all programs share.
#ifndef STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
#define STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_

#include <functional>
#include <string>

#include "platform/result.h"

namespace starfocus {

// Returns the line of --version: name, version of the library, and SIMD target.
std::string VersionText(const std::string& name);

// Runs a program and returns its exit code. Prints an error as one line to stderr, "<name>:
// <line>". Exceptions and failures to write to stdout are reported as errors. A closed pipe does
// not end the program. Signals that end the program leave no temporary files.
int RunProgram(const char* name, const std::function<Error()>& run);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_COMMAND_LINE_PROGRAM_H_
