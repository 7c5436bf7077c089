// SPDX-License-Identifier: Apache-2.0
// The reference's rectangle by the paper's rule: one block's views rendered and summed.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_

#include "tests/conformance/reference_field.h"

namespace reference {

// The weighted sum of all views over the rectangle, from the centre view at the lens's layer, whose
// edge goes on beyond it, and the captured views of the picture.
Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_RECTANGLE_H_
