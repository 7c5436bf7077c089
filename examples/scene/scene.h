// SPDX-License-Identifier: Apache-2.0
// Analytic scenes in disparity space.
//
// A scene is a set of surfaces in (x, y, d): centre-view position and disparity. It is laid out on
// a canvas of 1024x768 units with the origin in the middle (y downwards) and d in canvas units per
// unit u; a picture of another size scales all three alike. A ray is the line of points that one
// picture position p sees through lens position q when the lens is focused at disparity D:
// (x, y) = p + q * (d - D). The surface of the largest d wins. D = 0 gives the captured views.
#ifndef STARFOCUS_EXAMPLES_SCENE_SCENE_H_
#define STARFOCUS_EXAMPLES_SCENE_SCENE_H_

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "examples/scene/strands.h"

namespace starfocus {

inline constexpr double kCanvasWidth = 1024, kCanvasHeight = 768;

struct Color {
  double r = 0, g = 0, b = 0;  // codes, 255 is white, more are clipped; or their light
};
inline Color operator+(Color p, Color q) { return {p.r + q.r, p.g + q.g, p.b + q.b}; }
inline Color operator*(Color p, double k) { return {p.r * k, p.g * k, p.b * k}; }
inline Color Mix(Color p, Color q, double t) { return p * (1 - t) + q * t; }

// The points (x, y) = (ox, oy) + (u, v) * d.
struct Ray {
  double ox, oy, u, v;
};

// Where a ray meets a surface.
struct Hit {
  double x, y, d;     // in the scene
  double lx, ly;      // from the surface's centre, along its axes; strands: along and across
  double nx, ny, nz;  // normal: right, down, towards the camera
  size_t strand = 0;  // index in the surface's strands
};

struct Surface;
using Paint = Color (*)(const Surface&, const Hit&);

enum class Shape { kPlane, kEllipsoid, kStrands };
// What part of a plane there is: all, |lx| <= rx and |ly| <= ry, the ellipse of these radii, its
// outer ring of width `thickness`, or a leaf between two arcs.
enum class Outline { kNone, kBox, kEllipse, kRing, kLeaf };

struct Surface {
  Shape shape = Shape::kPlane;
  Outline outline = Outline::kNone;
  double cx = 0, cy = 0, cd = 0;    // centre
  double ax = 1, ay = 0;            // unit vector of the local x axis
  double rx = 0, ry = 0, rd = 0;    // radii along the local axes (rd: ellipsoids)
  double slope_x = 0, slope_y = 0;  // planes: d grows by so much per unit of scene x, y
  double thickness = 0;             // rings
  std::shared_ptr<const Strands> strands;
  bool foreground = false;  // counts as covered in the coverage of the centre view
  Paint paint = nullptr;
  Color color, second;
  double scale = 1;  // of the texture
  uint32_t seed = 0;
};

// Whether the ray meets the surface; fills in *hit if so.
bool Intersect(const Surface& surface, const Ray& ray, Hit* hit);

// `reach` bounds |x| and |y| of what is ever seen of an endless plane.
Bounds SurfaceBounds(const Surface& surface, double reach);

// A place to focus at, on the canvas.
struct NamedPoint {
  const char* name;
  double x, y;
};

struct Scene {
  std::string name;
  std::string description;
  std::vector<Surface> surfaces;
  std::vector<NamedPoint> points;  // near, middle, far
  bool seeded = false;             // another seed gives another scene

  // True if the scene has a foreground, and so a coverage map.
  bool HasForeground() const;
};

inline constexpr uint32_t kSceneSeed = 1;  // the default

// "portrait", "wires", "ramp", "lamps", "hair" or "grass"; none for any other name. The seed
// places the strands of hair and grass.
std::optional<Scene> MakeScene(const std::string& name, uint32_t seed = kSceneSeed);

Scene MakePortrait();
Scene MakeWires();
Scene MakeRamp();
Scene MakeLamps();
Scene MakeHair(uint32_t seed);
Scene MakeGrass(uint32_t seed);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_SCENE_H_
