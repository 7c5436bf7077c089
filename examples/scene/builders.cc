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

Surface Ellipsoid(double cx, double cy, double cd, double rx, double ry, double rd,
                  const Material& material) {
  Surface surface;
  surface.shape = Shape::kEllipsoid;
  surface.cx = cx;
  surface.cy = cy;
  surface.cd = cd;
  surface.rx = rx;
  surface.ry = ry;
  surface.rd = rd;
  Dress(material, &surface);
  return surface;
}

Surface Piece(Outline outline, double cx, double cy, double cd, double rx, double ry,
              const Material& material) {
  Surface surface = Ellipsoid(cx, cy, cd, rx, ry, 0, material);
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

Surface Wire(double x0, double y0, double d0, double x1, double y1, double d1, double radius,
             const Material& material) {
  const double dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy;
  Surface wire = Piece(Outline::kBox, 0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.5 * (d0 + d1),
                       0.5 * std::sqrt(square), radius, material);
  wire.slope_x = (d1 - d0) * dx / square;
  wire.slope_y = (d1 - d0) * dy / square;
  return Turned(wire, dx, dy);
}

Surface Leaf(double cx, double cy, double cd, double dx, double dy, double length, double width,
             double rise, const Material& material) {
  Surface leaf = Turned(Piece(Outline::kLeaf, cx, cy, cd, length, width, material), dx, dy);
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
