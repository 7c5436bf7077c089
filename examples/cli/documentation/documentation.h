// SPDX-License-Identifier: Apache-2.0
// What is written about a command line from its own options, so that it cannot tell of others.
#ifndef STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
#define STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace starfocus {

// The manual page in roff.
std::string ManualText(CLI::App* app);

// The completion script for bash. An option whose type name lists words, "near|far", is completed
// by those without capitals, one of DIR or FILE by names of files.
std::string CompletionText(CLI::App* app);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_DOCUMENTATION_DOCUMENTATION_H_
