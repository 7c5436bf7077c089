// SPDX-License-Identifier: Apache-2.0
// Paints fabrics, skin and hair.
#include <cmath>

#include "examples/scene/noise.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

double Grain(const Hit& hit, double size, uint32_t seed) {
  return Fractal(hit.lx / size, hit.ly / size, 3, seed);
}

// Returns how close (x, y) is to a dark dot; the result is 1 at the centre of a dot. Dots lie in
// some cells of a grid.
double Dots(double x, double y, double cell, double radius, double share, uint32_t seed) {
  const double cx = std::floor(x / cell), cy = std::floor(y / cell);
  const int32_t ix = static_cast<int32_t>(cx), iy = static_cast<int32_t>(cy);
  if (HashUnit(ix, iy, seed) > share) return 0;
  const double px = (cx + 0.3 + 0.4 * HashUnit(ix, iy, seed + 1)) * cell;
  const double py = (cy + 0.3 + 0.4 * HashUnit(ix, iy, seed + 2)) * cell;
  const double distance = std::sqrt((x - px) * (x - px) + (y - py) * (y - py));
  return 1 - Smooth(0.5 * radius, radius, distance);
}

Color Skin(const Surface& s, const Hit& hit) {
  const double pores = Grain(hit, 7, s.seed), blotches = Grain(hit, 40, s.seed + 9);
  Color color = Mix(s.color, s.second, 0.75 * blotches);
  color = color * (0.86 + 0.28 * pores);
  return color;
}

}  // namespace

Color Lit(Color color, const Hit& hit) {
  // The light comes from the direction (-0.48, -0.6, 0.64), a unit vector.
  const double direct = -0.48 * hit.nx - 0.6 * hit.ny + 0.64 * hit.nz;
  const double rim = 0.16 * (1 - hit.nz) * (hit.nx > 0 ? hit.nx : 0);
  return color * (0.42 + 0.62 * (direct > 0 ? direct : 0) + rim);
}

Color PaintKnit(const Surface& s, const Hit& hit) {
  const double stitch = 8 * s.scale;
  const double column = Wrap(hit.lx, stitch) / stitch - 0.5;
  const double row = hit.ly + 6 * s.scale * std::fabs(column);  // gives stitches the shape of a V
  const double yarn = Triangle(row, stitch);
  const double rib = 1 - 2.2 * column * column;
  const double band = Wrap(hit.ly + 4 * std::fabs(column), 7 * stitch) / stitch;
  Color color = band < 2 ? s.second : s.color;
  if (band >= 4 && band < 5 && Wrap(hit.lx, 2 * stitch) < stitch) color = s.second;
  const double fuzz = Grain(hit, 4, s.seed);
  return Lit(color * ((0.45 + 0.5 * yarn) * rib + 0.35 * fuzz), hit);
}

Color PaintTweed(const Surface& s, const Hit& hit) {
  const double width = 13 * s.scale;
  const double column = std::floor(hit.lx / width);
  const bool odd = Wrap(column, 2) >= 1;
  const double along = odd ? hit.ly + hit.lx : hit.ly - hit.lx;
  const double thread = Smooth(0.3, 0.7, Triangle(along, 7 * s.scale));
  const double fleck = Noise(hit.lx / 2.5, hit.ly / 2.5, s.seed);
  Color color = Mix(s.color, s.second, thread);
  if (fleck > 0.86) color = Mix(color, {210, 150, 80}, 0.6);
  return Lit(color * (0.75 + 0.45 * Grain(hit, 6, s.seed + 3)), hit);
}

Color PaintSkin(const Surface& s, const Hit& hit) { return Lit(Skin(s, hit), hit); }

Color PaintFace(const Surface& s, const Hit& hit) {
  Color color = Skin(s, hit);
  const double side = std::fabs(hit.lx);
  const double cx = (side - 58) / 34, cy = (hit.ly - 32) / 26;
  const double cheek = 1 - Smooth(0.1, 1, cx * cx + cy * cy);
  color = Mix(color, {222, 98, 84}, 0.5 * cheek);
  const double freckle = Dots(hit.lx, hit.ly, 9, 2.6, 0.55, s.seed + 20);
  const double fx = (side - 42) / 46, fy = (hit.ly - 22) / 26;
  color = Mix(color, {150, 88, 58}, 0.6 * freckle * (1 - Smooth(0.4, 1, fx * fx + fy * fy)));
  // A smile: two arcs with lips between them.
  const double upper = 70 - side * side / 95, lower = 82 - side * side / 62;
  const double lip = hit.ly - upper, depth = lower - upper;
  if (side < 38 && depth > 0 && lip > -2 && lip < depth + 2) {
    const double seam = std::fabs(lip - 0.42 * depth);
    color = Mix({196, 70, 74}, {98, 26, 34}, 1 - Smooth(0.5, 2.5, seam));
    color = color * (0.8 + 0.4 * Grain(hit, 4, s.seed + 30));
  }
  return Lit(color, hit);
}

Color PaintHair(const Surface& s, const Hit& hit) {
  const double wave = 5 * Noise(hit.lx / 30, hit.ly / 40, s.seed);
  const double strand = Fractal((hit.lx + wave) / 3.5, hit.ly / 60, 3, s.seed + 5);
  const double lock = Noise((hit.lx + 2 * wave) / 13, hit.ly / 90, s.seed + 6);
  return Lit(Mix(s.color, s.second, Clamp01(1.6 * strand - 0.5)) * (0.7 + 0.5 * lock), hit);
}

Color PaintFur(const Surface& s, const Hit& hit) {
  const double x = hit.lx / 5, y = hit.ly / 5;
  const double tuft = Fractal(x + 1.5 * Noise(y, x, s.seed), y, 4, s.seed + 1);
  return Lit(Mix(s.color, s.second, Smooth(0.3, 0.7, tuft)) * (0.6 + 0.7 * tuft), hit);
}

Color PaintEye(const Surface& s, const Hit& hit) {
  // The highlight of the eye is at the upper left, because the light comes from the upper left.
  const double radius = std::sqrt(hit.lx * hit.lx + hit.ly * hit.ly);
  const double gx = hit.lx + 3.5, gy = hit.ly + 4;
  if (gx * gx + gy * gy < 5) return {255, 255, 255};
  if (radius < 4.6) return {14, 12, 16};
  if (radius < 10.5) {
    const double spoke = Noise(hit.lx * 0.9, hit.ly * 0.9, s.seed);
    return s.color * (0.6 + 0.7 * spoke) * (1 - 0.5 * Smooth(8.5, 10.5, radius));
  }
  return Lit(Color{244, 240, 232} * (0.9 + 0.14 * Grain(hit, 4, s.seed)), hit);
}

}  // namespace starfocus
