// SPDX-License-Identifier: Apache-2.0
// Input of the passes that compute a coverage map.
#ifndef STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_
#define STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_

#include "lib/coverage/coverage_map.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// Data that all passes read, and the map that they write.
struct CoverageInput {
  const simd::Kernels* kernels;
  const Window* window;  // at layer 0
  const CoverageMap* map;
};

// Returns true if the light field has coverage; otherwise the passes estimate it.
inline bool HasGiven(const CoverageInput& in) { return in.window->given_coverage.data != nullptr; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_
