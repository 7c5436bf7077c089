// SPDX-License-Identifier: Apache-2.0
// Refocuses one rectangle in the reference by line scans, as the paper does: renders and sums the
// views of a block.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_

#include "tests/conformance/reference_field.h"

namespace reference {

// Returns the weighted sum of all views over the rectangle. The inputs are the centre view at the
// layer of the lens, with repeated edges, and the captured views of the picture.
Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_
