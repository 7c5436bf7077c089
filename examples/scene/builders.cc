// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/builders.h"

#include <cmath>
#include <utility>

namespace starfocus {
namespace {

void Dress(const Material& material, Surface* surface) {
  surface->paint = material.paint;
  surface->color = material.color;
  surface->second = material.second;
  surface->scale = material.scale;
  surface->seed = material.seed;
}

}  // namespace

Surface Ellipsoid(const Position& centre, const Radii& radii, const Material& material) {
  Surface surface;
  surface.shape = Shape::kEllipsoid;
  surface.cx = centre.x;
  surface.cy = centre.y;
  surface.cd = centre.d;
  surface.rx = radii.x;
  surface.ry = radii.y;
  surface.rd = radii.d;
  Dress(material, &surface);
  return surface;
}

Surface Piece(Outline outline, const Position& centre, const Radii& radii,
              const Material& material) {
  Surface surface = Ellipsoid(centre, radii, material);
  surface.shape = Shape::kPlane;
  surface.outline = outline;
  return surface;
}

Surface Turned(Surface surface, double dx, double dy) {
  const double length = std::sqrt(dx * dx + dy * dy);
  surface.ax = dx / length;
  surface.ay = dy / length;
  return surface;
}

Surface Wire(const Position& from, const Position& to, double radius, const Material& material) {
  const double dx = to.x - from.x, dy = to.y - from.y, square = dx * dx + dy * dy;
  const Position middle = {0.5 * (from.x + to.x), 0.5 * (from.y + to.y), 0.5 * (from.d + to.d)};
  Surface wire = Piece(Outline::kBox, middle, {0.5 * std::sqrt(square), radius}, material);
  wire.slope_x = (to.d - from.d) * dx / square;
  wire.slope_y = (to.d - from.d) * dy / square;
  return Turned(wire, dx, dy);
}

Surface Leaf(const Position& centre, const Point& direction, double length, double width,
             double rise, const Material& material) {
  Surface leaf =
      Turned(Piece(Outline::kLeaf, centre, {length, width}, material), direction.x, direction.y);
  leaf.slope_x = rise / length * leaf.ax;
  leaf.slope_y = rise / length * leaf.ay;
  return leaf;
}

Surface Tuft(std::vector<Strand> strands, const Material& material) {
  Surface tuft;
  tuft.shape = Shape::kStrands;
  tuft.strands = std::make_shared<const Strands>(std::move(strands));
  Dress(material, &tuft);
  return tuft;
}

}  // namespace starfocus
