// SPDX-License-Identifier: Apache-2.0
// Reference of the coverage of thin structures: splits pixels near large depth edges into a near
// and a far surface. Disparities are multiples of 1/64 pixel, as in the engine. Between passes,
// coverage is rounded to 1/128, and the certainty of the farther surface's light is rounded down to
// 1/256, as in the engine; weighted light of near surfaces is rounded, too. All other values are
// unrounded doubles.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_

#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

struct PartedPixel {
  bool parted = false;
  double alpha = 0;          // Share of the pixel that the near surface covers.
  double near = 0, far = 0;  // Disparities of the nearer and the farther surface, in 1/64 pixel.
  Colour light = {0, 0, 0};  // Light of the far surface.
};

// Returns the pixels of the centre view, row by row. Pixels are split by the coverage of the scene
// if the scene has coverage, and by the map and the colours otherwise.
std::vector<PartedPixel> PartPixels(const test::Scene& scene, int transfer);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_COVERAGE_H_
