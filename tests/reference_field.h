// The reference's extended rectangle, and colours of captured views.
#ifndef STARFOCUS_TESTS_REFERENCE_FIELD_H_
#define STARFOCUS_TESTS_REFERENCE_FIELD_H_

#include "tests/reference_line.h"

namespace reference {

// A rectangle of a layer and the border it is rendered from, in the layer's pixels.
struct Rectangle {
  int x, y, width, height;
  int left, right, top, bottom;
};

// A rectangle with its border, from the centre view at the lens's layer, whose edge goes on beyond
// it; sharp pixels beside a more defocused surface are free of it.
Picture ExtendedRectangle(const LightField& field, const Picture& layer, const Lens& lens,
                          const Rectangle& rect);

// The colour at (x, y) of the layer in the captured view at (u2, v2), in halves of a unit.
Colour Read(const LightField& field, int layer, int u2, int v2, double x, double y);

}  // namespace reference

#endif  // STARFOCUS_TESTS_REFERENCE_FIELD_H_
