// SPDX-License-Identifier: Apache-2.0
// Generates the documentation of a command line. The parser uses the same tables of options, so the
// documentation and the parser always agree.
#ifndef STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
#define STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_

#include <string>

#include "examples/command_line/command.h"

namespace starfocus {

// Returns the manual page in roff.
std::string ManualText(const Program& program);

// Returns the completion script for bash. If the type of an option lists words, such as "near|far",
// the script completes the words without capitals. For DIR and FILE, the script completes file
// names.
std::string CompletionText(const Program& program);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
