// SPDX-License-Identifier: Apache-2.0
// Reads and writes timing coefficients in JSON files, for `starfocus-lab calibrate` and `refocus
// --timing`.
#ifndef STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_
#define STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_

#include <string>

#include "examples/cli/json/json.h"
#include "platform/result.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// Returns the member "timing" of a timing file.
Json TimingJson(const starfocus_timing& timing);

// Reads the member "timing", which must contain all coefficients and nothing else. Members other
// than "timing" are ignored as comments.
Result<starfocus_timing> ReadTiming(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_
