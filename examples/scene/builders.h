// SPDX-License-Identifier: Apache-2.0
// Functions that create the surfaces of scenes.
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

// Position of a surface: x and y in the scene, and disparity d.
struct Position {
  double x, y, d;
};

// Radii of a surface along the axes x, y and d of the scene.
struct Radii {
  double x, y, d = 0;
};

Surface Ellipsoid(const Position& centre, const Radii& radii, const Material& material);

// Creates a planar surface. Outline::kNone ignores the radii.
Surface Piece(Outline outline, const Position& centre, const Radii& radii,
              const Material& material);

// Rotates a surface so that its local x axis points towards (dx, dy), which need not be a unit
// vector.
Surface Turned(Surface surface, double dx, double dy);

// Creates a flat wire with half width `radius` between two positions.
Surface Wire(const Position& from, const Position& to, double radius, const Material& material);

// Creates a leaf whose tip lies in `direction` from `centre`. Disparity grows by `rise` towards the
// tip.
Surface Leaf(const Position& centre, const Point& direction, double length, double width,
             double rise, const Material& material);

// Combines strands into one surface.
Surface Tuft(std::vector<Strand> strands, const Material& material);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_BUILDERS_H_
