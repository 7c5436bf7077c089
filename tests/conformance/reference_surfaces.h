// SPDX-License-Identifier: Apache-2.0
// Finds the visible and the hidden surfaces of an extended rectangle, in the reference.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/conformance/reference_field.h"

namespace reference {

struct Surface {
  int disparity;  // in 1/64
  Colour colour;
  double share = 1;   // Share of the pixel that this surface covers; surfaces behind get the rest.
  bool ends = false;  // True if the surface ends at a depth edge next to the pixel.
  // If no captured view sees behind the edge: the distance and the directions of the pixels whose
  // colours this surface repeats.
  int repeated = 0;
  std::vector<Direction> towards = {};
};

// Surfaces of each pixel, the nearest first.
struct SurfaceMap {
  int width, height;
  std::vector<std::vector<Surface>> pixels;

  // Returns the surfaces of a pixel. Beyond the map, the outermost pixels are repeated.
  const std::vector<Surface>& At(int x, int y) const {
    return pixels[size_t(std::clamp(y, 0, height - 1)) * size_t(width) +
                  size_t(std::clamp(x, 0, width - 1))];
  }
};

// Finds the surfaces of an extended rectangle at (x0, y0) of the layer.
SurfaceMap FindLayeredDepth(const LightField& field, const Picture& extended, const Lens& lens,
                            int x0, int y0);

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_SURFACES_H_
