// SPDX-License-Identifier: Apache-2.0
// Timing coefficients in JSON files: what `starfocus-lab calibrate` writes and `refocus --timing`
// reads.
#ifndef STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_
#define STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_

#include <string>

#include "examples/cli/json/json.h"
#include "platform/result.h"
#include "starfocus/starfocus.h"

namespace starfocus {

// The member "timing" of such a file.
Json TimingJson(const starfocus_timing& timing);

// Reads the member "timing"; it must hold every coefficient and nothing else. Other members of the
// file are remarks.
Result<starfocus_timing> ReadTiming(const std::string& path);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_CLI_ENGINE_TIMING_FILE_H_
