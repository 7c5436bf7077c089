// The reference's rectangle: one block's views rendered and summed.
#ifndef STARFOCUS_TESTS_REFERENCE_RECTANGLE_H_
#define STARFOCUS_TESTS_REFERENCE_RECTANGLE_H_

#include "tests/reference_line.h"

namespace reference {

// A rectangle of a layer and the border it is rendered from, in the layer's pixels.
struct Rectangle {
  int x, y, width, height;
  int left, right, top, bottom;
};

// The weighted sum of all views over the rectangle, from the centre view at the lens's layer, whose
// edge goes on beyond it, and the captured views of the picture.
Picture RefocusRectangle(const LightField& field, const Picture& centre, const Lens& lens,
                         const Rectangle& rectangle);

}  // namespace reference

#endif  // STARFOCUS_TESTS_REFERENCE_RECTANGLE_H_
