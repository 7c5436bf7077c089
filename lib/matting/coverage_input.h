// SPDX-License-Identifier: Apache-2.0
// Defines the input of the passes that compute a coverage map (passes.h).
#ifndef STARFOCUS_LIB_MATTING_COVERAGE_INPUT_H_
#define STARFOCUS_LIB_MATTING_COVERAGE_INPUT_H_

#include "lib/io/input.h"
#include "lib/matting/coverage_map.h"

namespace starfocus {

// The data that all passes read, and the coverage map that all passes write.
struct CoverageInput {
  const Input* input;
  const CoverageMap* map;
};

// Returns true if the light field contains coverage. If the light field contains no coverage, the
// passes estimate the coverage.
inline bool HasGiven(const CoverageInput& in) { return in.input->given_coverage.data != nullptr; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_MATTING_COVERAGE_INPUT_H_
