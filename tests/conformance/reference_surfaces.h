// SPDX-License-Identifier: Apache-2.0
// The reference's surfaces: what the pixels of an extended rectangle show, and what lies behind.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/conformance/reference_field.h"

namespace reference {

struct Surface {
  int disparity;  // 1/64
  Colour colour;
  double share = 1;   // of the pixel; what is behind it has the rest
  bool ends = false;  // beside a depth edge
  // Behind an edge that no captured view looks behind: the pixels that it repeats lie so
  // far away in these directions.
  int repeated = 0;
  std::vector<Direction> towards = {};
};

// The surfaces at each pixel, the nearest first.
struct SurfaceMap {
  int width, height;
  std::vector<std::vector<Surface>> pixels;

  // Beyond the map its outermost pixels go on.
  const std::vector<Surface>& At(int x, int y) const {
    return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) +
                  size_t(std::clamp(x, 0, width - 1))];
  }
};

// Those of an extended rectangle at (x0, y0) of the layer.
SurfaceMap FindLayeredDepth(const LightField& field, const Picture& extended, const Lens& lens,
                            int x0, int y0);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_
