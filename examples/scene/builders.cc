// SPDX-License-Identifier: Apache-2.0

#include "examples/scene/builders.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "examples/scene/scene.h"

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

namespace {

void ToLocal(const Surface& s, double dx, double dy, double* lx, double* ly) {
  *lx = dx * s.ax + dy * s.ay;
  *ly = dy * s.ax - dx * s.ay;
}

bool Inside(const Surface& s, double lx, double ly) {
  const double x = s.rx > 0 ? lx / s.rx : 0, y = s.ry > 0 ? ly / s.ry : 0;
  const double square = x * x + y * y;
  switch (s.outline) {
    case Outline::kNone:
      return true;
    case Outline::kBox:
      return std::fabs(x) <= 1 && std::fabs(y) <= 1;
    case Outline::kEllipse:
      return square <= 1;
    case Outline::kRing: {
      const double ix = lx / (s.rx - s.thickness), iy = ly / (s.ry - s.thickness);
      return square <= 1 && ix * ix + iy * iy >= 1;
    }
    case Outline::kLeaf:
      return std::fabs(x) <= 1 && std::fabs(y) <= (1 - x * x) * (1.1 - 0.3 * x);
  }
  return false;
}

bool IntersectPlane(const Surface& s, const Ray& ray, Hit* hit) {
  const double denominator = 1 - s.slope_x * ray.u - s.slope_y * ray.v;
  if (denominator <= 0) return false;
  const double d = (s.cd + s.slope_x * (ray.ox - s.cx) + s.slope_y * (ray.oy - s.cy)) / denominator;
  const double x = ray.ox + ray.u * d, y = ray.oy + ray.v * d;
  double lx, ly;
  ToLocal(s, x - s.cx, y - s.cy, &lx, &ly);
  if (!Inside(s, lx, ly)) return false;
  *hit = {x, y, d, lx, ly, 0, 0, 1, 0};
  return true;
}

bool IntersectEllipsoid(const Surface& s, const Ray& ray, Hit* hit) {
  // Local coordinates divided by the radii are linear in t = d - cd: (p + q * t, t / rd).
  double px, py, qx, qy;
  ToLocal(s, ray.ox + ray.u * s.cd - s.cx, ray.oy + ray.v * s.cd - s.cy, &px, &py);
  ToLocal(s, ray.u, ray.v, &qx, &qy);
  px /= s.rx;
  py /= s.ry;
  qx /= s.rx;
  qy /= s.ry;
  const double a = qx * qx + qy * qy + 1 / (s.rd * s.rd);
  const double b = px * qx + py * qy, c = px * px + py * py - 1;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return false;
  const double t = (std::sqrt(discriminant) - b) / a;
  const double nx = px + qx * t, ny = py + qy * t;
  const double d = s.cd + t;
  *hit = {ray.ox + ray.u * d,    ray.oy + ray.v * d,    d,        nx * s.rx, ny * s.ry,
          nx * s.ax - ny * s.ay, nx * s.ay + ny * s.ax, t / s.rd, 0};
  return true;
}

bool IntersectStrands(const Surface& s, const Ray& ray, Hit* hit) {
  Point origin, slope;
  ToLocal(s, ray.ox - s.cx, ray.oy - s.cy, &origin.x, &origin.y);
  ToLocal(s, ray.u, ray.v, &slope.x, &slope.y);
  StrandHit found;
  if (!s.strands->Find(origin, slope.x, slope.y, &found)) return false;
  const double x = ray.ox + ray.u * found.d, y = ray.oy + ray.v * found.d;
  *hit = {x, y, found.d, found.along, found.across, 0, 0, 1, found.strand};
  return true;
}

}  // namespace

bool Intersect(const Surface& surface, const Ray& ray, Hit* hit) {
  if (surface.shape == Shape::kStrands) return IntersectStrands(surface, ray, hit);
  return surface.shape == Shape::kPlane ? IntersectPlane(surface, ray, hit)
                                        : IntersectEllipsoid(surface, ray, hit);
}

namespace {

Bounds StrandBounds(const Surface& s) {
  const Bounds& own = s.strands->bounds();
  const double mx = 0.5 * (own.x0 + own.x1), my = 0.5 * (own.y0 + own.y1);
  const double rx = 0.5 * (own.x1 - own.x0), ry = 0.5 * (own.y1 - own.y0);
  const double x = s.cx + mx * s.ax - my * s.ay, y = s.cy + mx * s.ay + my * s.ax;
  const double wide = std::fabs(s.ax) * rx + std::fabs(s.ay) * ry;
  const double high = std::fabs(s.ay) * rx + std::fabs(s.ax) * ry;
  return {x - wide, x + wide, y - high, y + high, own.d0, own.d1};
}

}  // namespace

Bounds SurfaceBounds(const Surface& s, double reach) {
  if (s.shape == Shape::kStrands) return StrandBounds(s);
  const bool endless = s.shape == Shape::kPlane && s.outline == Outline::kNone;
  // The outline of a leaf reaches up to 1.14 times the leaf's radius ry.
  const double ry = s.outline == Outline::kLeaf ? 1.2 * s.ry : s.ry;
  const double wide = std::fabs(s.ax) * s.rx + std::fabs(s.ay) * ry;
  const double high = std::fabs(s.ay) * s.rx + std::fabs(s.ax) * ry;
  Bounds box = {s.cx - wide, s.cx + wide, s.cy - high, s.cy + high, s.cd - s.rd, s.cd + s.rd};
  if (endless) box = {-reach, reach, -reach, reach, s.cd, s.cd};
  if (s.shape == Shape::kPlane) {
    const double x = std::max(std::fabs(box.x0 - s.cx), std::fabs(box.x1 - s.cx));
    const double y = std::max(std::fabs(box.y0 - s.cy), std::fabs(box.y1 - s.cy));
    const double rise = std::fabs(s.slope_x) * x + std::fabs(s.slope_y) * y;
    box.d0 = s.cd - rise;
    box.d1 = s.cd + rise;
  }
  return box;
}

bool Scene::HasForeground() const {
  return std::any_of(surfaces.begin(), surfaces.end(),
                     [](const Surface& surface) { return surface.foreground; });
}

std::optional<Scene> MakeScene(const std::string& name, uint32_t seed, double glare) {
  if (name == "portrait") return MakePortrait();
  if (name == "wires") return MakeWires();
  if (name == "ramp") return MakeRamp();
  if (name == "lamps") return MakeLamps(glare);
  if (name == "hair") return MakeHair(seed);
  if (name == "grass") return MakeGrass(seed);
  if (name == "cutout") return MakeCutout(seed);
  return {};
}

}  // namespace starfocus
