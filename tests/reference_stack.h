// The reference's rectangle by the rule of cells: one block as a stack of slices, which each view
// shows moved against each other.
#ifndef STARFOCUS_TESTS_REFERENCE_STACK_H_
#define STARFOCUS_TESTS_REFERENCE_STACK_H_

#include <cstddef>

#include "tests/reference_field.h"

namespace reference {

// As RefocusRectangle. `slice_samples`: the memory of all slices together, beyond which they get
// coarser.
Picture RefocusStack(const LightField& field, const Picture& centre, const Lens& lens,
                     const Rectangle& rectangle, size_t slice_samples);

}  // namespace reference

#endif  // STARFOCUS_TESTS_REFERENCE_STACK_H_
