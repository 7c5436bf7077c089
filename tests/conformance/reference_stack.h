// SPDX-License-Identifier: Apache-2.0
// Refocuses one rectangle in the reference with slices and subapertures. The pixels of each tile
// are divided into a stack of slices. Each view moves the slices of a stack by different distances.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_

#include <cstddef>

#include "tests/conformance/reference_field.h"

namespace reference {

// Limits of the number of slices (`most`) and of their total area in pixels (`area`). If a limit is
// exceeded, slices become coarser. `range` is the largest difference of blur, in pixels, between
// pixels of a slice near the focus.
struct Slicing {
  size_t most;
  int area;
  double range;
};

// Refocuses a rectangle as RefocusRectangle does, but composites slices instead of scanning lines.
Picture CompositeRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                           const Rectangle& rectangle, const Slicing& slicing);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_STACK_H_
