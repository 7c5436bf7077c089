// SPDX-License-Identifier: Apache-2.0
// Analytic scenes in disparity space.
//
// A scene is a set of surfaces in (x, y, d): position in the centre view and disparity. The canvas
// has 1024x768 units, its origin is the centre, y points downwards, and d is in canvas units per
// unit of u. In a picture of another size, x, y and d are scaled equally. A ray consists of the
// points that picture position p sees through lens position q. If the lens is focused at disparity
// D, these points are (x, y) = p + q * (d - D). If the disparities from D0 to D1 are in focus, D is
// the nearest of them to d. The surface with the largest d is visible. The captured views are the
// rays with D = 0.
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
  double r = 0, g = 0, b = 0;  // codes (255 is white, larger codes are clipped), or light
};
inline Color operator+(Color p, Color q) { return {p.r + q.r, p.g + q.g, p.b + q.b}; }
inline Color operator*(Color p, double k) { return {p.r * k, p.g * k, p.b * k}; }
inline Color Mix(Color p, Color q, double t) { return p * (1 - t) + q * t; }

// A ray, which consists of the points (x, y, d) with (x, y) = (ox, oy) + (u, v) * d.
struct Ray {
  double ox, oy, u, v;
};

// Intersection of a ray and a surface.
struct Hit {
  double x, y, d;  // Position in the scene.
  double lx, ly;   // Position relative to the surface's centre, along its axes; for strands, along
                   // and across the strand.
  double nx, ny, nz;  // Surface normal; x points right, y down, z towards the camera.
  size_t strand = 0;  // Index of the strand in the surface's strands.
};

struct Surface;
using Paint = Color (*)(const Surface&, const Hit&);

enum class Shape { kPlane, kEllipsoid, kStrands };
// Outline of a planar surface. kNone is an infinite plane. kBox is |lx| <= rx and |ly| <= ry.
// kEllipse is an ellipse with the radii rx and ry. kRing is the outer ring of this ellipse with
// width `thickness`. kLeaf is the area between two arcs.
enum class Outline { kNone, kBox, kEllipse, kRing, kLeaf };

struct Surface {
  Shape shape = Shape::kPlane;
  Outline outline = Outline::kNone;
  double cx = 0, cy = 0, cd = 0;    // Centre.
  double ax = 1, ay = 0;            // Unit vector of the local x axis.
  double rx = 0, ry = 0, rd = 0;    // Radii along the local axes; rd is used for ellipsoids only.
  double slope_x = 0, slope_y = 0;  // Change of a plane's disparity per unit of x and of y.
  double thickness = 0;             // Width of a ring.
  std::shared_ptr<const Strands> strands;  // relative to the centre, along the local axes
  bool foreground = false;                 // true if the surface counts in the coverage or matte
  Paint paint = nullptr;
  Color color, second;
  double scale = 1;  // scale of the texture
  uint32_t seed = 0;
};

// Returns true if the ray intersects the surface, and sets *hit in that case.
bool Intersect(const Surface& surface, const Ray& ray, Hit* hit);

// Returns the bounds of a surface. `reach` limits |x| and |y| of the visible part of an infinite
// plane.
Bounds SurfaceBounds(const Surface& surface, double reach);

// Where the camera has moved to. Picture position p of its centre view shows the points
// (x, y) = p + (x, y) of the camera + (u, v) of the camera * d.
struct Camera {
  double x = 0, y = 0;  // By turning: all points move by the same distance.
  double u = 0, v = 0;  // By moving, in units of the position of a view; at most 1 away from 0.
};

// A point of the canvas to focus on.
struct NamedPoint {
  const char* name;
  double x, y;
};

struct Scene {
  std::string name;
  std::string description;
  std::vector<Surface> surfaces;
  Camera camera;
  // Samples along each side of a pixel of a view, unless the pixel is near strands.
  int view_grid = 4;
  std::vector<NamedPoint> points;  // Points to focus on, from near to far.
  bool seeded = false;             // True if the scene depends on the seed.
  // True if other near surfaces do not belong to the foreground. The share of a pixel that the
  // foreground covers is then the matte of a subject, and not the coverage of the disparity map.
  bool is_matte = false;

  // Returns true if the scene has a foreground, and therefore a coverage map or a matte.
  bool HasForeground() const;
};

inline constexpr uint32_t kSceneSeed = 1;  // default seed
// Factor of the codes of bright lamps: of lamps four times as bright as white, and 64 times.
inline constexpr double kGlare = 1.825, kHdrGlare = 5.9;

// Creates the scene "portrait", "wires", "ramp", "lamps", "hair", "grass" or "cutout". Returns
// nullopt for any other name. The seed determines the strands of hair, grass and cutout.
std::optional<Scene> MakeScene(const std::string& name, uint32_t seed = kSceneSeed,
                               double glare = kGlare);

Scene MakePortrait();
Scene MakeWires();
Scene MakeRamp();
Scene MakeLamps(double glare);
Scene MakeHair(uint32_t seed);
Scene MakeGrass(uint32_t seed);
Scene MakeCutout(uint32_t seed);

}  // namespace starfocus

#endif  // STARFOCUS_EXAMPLES_SCENE_SCENE_H_
