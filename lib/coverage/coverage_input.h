// SPDX-License-Identifier: Apache-2.0
// What the passes that find a coverage map work on.
#ifndef STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_
#define STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_

#include "lib/coverage/coverage_map.h"
#include "lib/input/window.h"
#include "simd/kernels.h"

namespace starfocus {

// What all passes read, and the map that they write.
struct CoverageInput {
  const simd::Kernels* kernels;
  const Window* window;  // at level 0
  const CoverageMap* map;
};

// Whether the light field has coverage; else it is found.
inline bool HasGiven(const CoverageInput& in) { return in.window->given_coverage.data != nullptr; }

}  // namespace starfocus

#endif  // STARFOCUS_LIB_COVERAGE_COVERAGE_INPUT_H_
