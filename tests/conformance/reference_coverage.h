// SPDX-License-Identifier: Apache-2.0
// Reference of the coverage of thin structures: splits pixels near large depth edges into a near
// and a far surface. Disparities are decided on the engine's grid of 1/64. Between passes, coverage
// is rounded to 1/128 and the certainty of light down to 1/256, as the engine stores them. All
// other values are unrounded doubles.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_

#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

struct PartedPixel {
  bool parted = false;
  double alpha = 0;          // share of the pixel that the near surface covers
  double near = 0, far = 0;  // disparities in 1/64
  Colour light = {0, 0, 0};  // light of the far surface
};

// Returns the pixels of the centre view, row by row. If the scene has coverage, the coverage splits
// the pixels; otherwise the map and the colours split them.
std::vector<PartedPixel> PartPixels(const test::Scene& scene, int transfer);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
