// SPDX-License-Identifier: Apache-2.0
// The reference's rectangle by the rule of subapertures: one block, tile by tile, as a stack of
// slices, which each view shows moved against each other.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_

#include <cstddef>

#include "tests/conformance/reference_field.h"

namespace reference {

// What slices are cut by: their number and area, beyond which they get coarser, and the pixels that
// they may lie apart at the rim where they are sharp.
struct Slicing {
  size_t most;
  int area;
  double range;
};

// As RefocusRectangle.
Picture CompositeRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                           const Rectangle& rectangle, const Slicing& slicing);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
