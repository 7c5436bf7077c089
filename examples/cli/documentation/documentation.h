// SPDX-License-Identifier: Apache-2.0
// What is written about a command line from its own options, so that it cannot tell of others.
#ifndef STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
#define STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_

#include <string>

#include "examples/command_line/command.h"

namespace starfocus {

// The manual page in roff.
std::string ManualText(const Program& program);

// The completion script for bash. An option whose type name lists words, "near|far", is completed
// by those without capitals, one of DIR or FILE by names of files.
std::string CompletionText(const Program& program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
