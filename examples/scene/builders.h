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

// A position: scene x and y, and disparity.
struct Position {
  double x, y, d;
};

// Radii along the axes of a Position.
struct Radii {
  double x, y, d = 0;
};

Surface Ellipsoid(const Position& centre, const Radii& radii, const Material& material);

// A plane piece; for Outline::kNone the radii do not matter.
Surface Piece(Outline outline, const Position& centre, const Radii& radii,
              const Material& material);

// Turns the local x axis towards (dx, dy), which need not be a unit vector.
Surface Turned(Surface surface, double dx, double dy);

// A flat wire of half width `radius` from one position to another.
Surface Wire(const Position& from, const Position& to, double radius, const Material& material);

// A leaf with its tip in `direction` from its middle; d grows by `rise` to the tip.
Surface Leaf(const Position& centre, const Point& direction, double length, double width,
             double rise, const Material& material);

// Strands as one surface.
Surface Tuft(std::vector<Strand> strands, const Material& material);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_BUILDERS_H_
