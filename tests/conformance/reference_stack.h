// SPDX-License-Identifier: Apache-2.0
// The reference's rectangle by the rule of subapertures: one block, cut by cut, as a stack of
// slices, which each view shows moved against each other.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_

#include <cstddef>

#include "lib/slices/depth_slices.h"
#include "tests/conformance/reference_field.h"

namespace reference {

// What slices are cut by: what all together may take and their number, beyond which they get
// coarser, and the pixels that they may lie apart at the rim where they are sharp.
struct Slicing {
  const starfocus::SliceLimits* limits;
  size_t most;
  double range;
};

// What the slices of a cut may take of a lens that blurs up to `blur` pixels, with blocks up
// to `side`: the formula of lib/slices/depth_slices.h.
starfocus::SliceLimits LimitsOf(int side, double blur);

// As RefocusRectangle.
Picture CompositeRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                           const Rectangle& rectangle, const Slicing& slicing);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
