// SPDX-License-Identifier: Apache-2.0
// Describes an input as JSON.
#ifndef STARFOCUS_EXAMPLES_CLI_INPUT_DESCRIBE_H_
#define STARFOCUS_EXAMPLES_CLI_INPUT_DESCRIBE_H_

#include "examples/cli/json/json.h"
#include "platform/readers/capture.h"

namespace starfocus {

// Returns the format of an input whose views are loaded, the facts in its files, and the size,
// number and positions of its views.
Json Describe(const Capture& capture);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_INPUT_DESCRIBE_H_
