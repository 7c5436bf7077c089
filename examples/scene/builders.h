// SPDX-License-Identifier: Apache-2.0
// Short ways to describe surfaces.
#ifndef STARFOCUS_EXAMPLES_SCENE_BUILDERS_H_
#define STARFOCUS_EXAMPLES_SCENE_BUILDERS_H_

#include "examples/scene/scene.h"

namespace starfocus {

struct Material {
  Paint paint;
  Color color, second;
  double scale = 1;
  uint32_t seed = 0;
};

Surface Ellipsoid(double cx, double cy, double cd, double rx, double ry, double rd,
                  const Material& material);

// A plane piece; for Outline::kNone the radii do not matter.
Surface Piece(Outline outline, double cx, double cy, double cd, double rx, double ry,
              const Material& material);

// Turns the local x axis towards (dx, dy), which need not be a unit vector.
Surface Turned(Surface surface, double dx, double dy);

// A flat wire of half width `radius` from (x0, y0, d0) to (x1, y1, d1).
Surface Wire(double x0, double y0, double d0, double x1, double y1, double d1, double radius,
             const Material& material);

// A leaf with its tip in the direction (dx, dy) from its middle; d grows by `rise` to the tip.
Surface Leaf(double cx, double cy, double cd, double dx, double dy, double length, double width,
             double rise, const Material& material);

// Strands as one surface.
Surface Tuft(std::vector<Strand> strands, const Material& material);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_BUILDERS_H_
