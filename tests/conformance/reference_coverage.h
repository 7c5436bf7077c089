// SPDX-License-Identifier: Apache-2.0
// Coverage of thin structure once more: which pixels near large depth edges are parted into a near
// and a far surface, and how. Disparities are decided on the engine's grid (1/64), coverage between
// the passes is rounded to 1/128 and what is known of light down to 1/256, as the engine
// keeps them; all else is in double and unrounded.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_

#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

struct PartedPixel {
  bool parted = false;
  double alpha = 0;          // how much of the pixel the near surface covers
  double near = 0, far = 0;  // disparities, 1/64
  Colour light = {0, 0, 0};  // of the far surface
};

// The pixels of the centre view, row by row: parted by the scene's coverage if it has any, else by
// its map and colours.
std::vector<PartedPixel> PartPixels(const test::Scene& scene, int transfer);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
