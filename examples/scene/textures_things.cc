// SPDX-License-Identifier: Apache-2.0
// Paints walls, furniture, plants and lights.
#include <cmath>

#include "examples/scene/noise.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

double Weave(const Hit& hit, double size, uint32_t seed) {
  return Fractal(hit.lx / size, hit.ly / size, 4, seed);
}

// Returns a damask pattern in [0, 1]: petals of rosettes, and tendrils between them.
double Damask(double x, double y) {
  const double cell = 64;
  const double row = std::floor(y / cell);
  const double px = Wrap(x + (Wrap(row, 2) >= 1 ? cell / 2 : 0), cell) - cell / 2;
  const double py = Wrap(y, cell) - cell / 2;
  const double ax = std::fabs(px), ay = std::fabs(py);
  const double radius = std::sqrt(px * px + py * py);
  // The rosette has four petals, because |x y| is largest along the diagonals.
  const double petal = radius > 0 ? 2 * ax * ay / (radius * radius) : 0;
  const double bloom = Smooth(2, 0, std::fabs(radius - (10 + 13 * petal)) - 1.2);
  const double heart = Smooth(7, 5.5, radius);
  const double stem = Smooth(2.2, 0.8, std::fabs(ax + ay - 31 - 3 * Triangle(ax, 10)));
  return Clamp01(bloom + heart + 0.8 * stem);
}

}  // namespace

Color PaintWallpaper(const Surface& s, const Hit& hit) {
  const double weave = 0.5 * (Triangle(hit.x, 5) + Triangle(hit.y, 5));
  const double cloud = Fractal(hit.x / 90, hit.y / 90, 6, s.seed);
  const Color color = Mix(s.color, s.second, Damask(hit.x, hit.y));
  // A lamp outside the picture lights the upper right.
  const double dx = (hit.x - 260) / 700, dy = (hit.y + 260) / 620;
  const double glow = 1.25 - 0.55 * Smooth(0, 1.6, dx * dx + dy * dy);
  return color * (glow * (0.55 + 0.2 * weave + 0.7 * cloud));
}

Color PaintWood(const Surface& s, const Hit& hit) {
  // Draws planks as strips without perspective, each with a different grain.
  const double plank = std::floor(hit.ly / (34 * s.scale));
  const uint32_t seed = s.seed + Hash(static_cast<int32_t>(plank), 0, s.seed) % 1000u;
  const double bend = 10 * Noise(hit.lx / 120, hit.ly / 20, seed);
  const double ring = Fractal(hit.lx / 70, (hit.ly + bend) / 4, 4, seed + 1);
  const double fibre = Noise(hit.lx / 9, hit.ly / 1.8, seed + 2);
  const double gap = Wrap(hit.ly, 34 * s.scale);
  Color color = Mix(s.color, s.second, Smooth(0.25, 0.75, ring)) * (0.75 + 0.4 * fibre);
  color = color * (0.85 + 0.3 * HashUnit(static_cast<int32_t>(plank), 1, s.seed));
  if (gap < 2.2) color = color * 0.4;
  return color;
}

Color PaintGlaze(const Surface& s, const Hit& hit) {
  // Paints bands of zigzags and dots around the pot. The glaze darkens towards the rim.
  const double y = hit.ly / s.ry * 100;
  const double curve = hit.lx / (0.35 + 0.65 * hit.nz);
  Color color = s.color;
  if (y > -62 && y < -30) {
    const double zigzag = -58 + 24 * Triangle(curve, 26);
    if (std::fabs(y - zigzag) < 5) color = s.second;
  } else if (y > -16 && y < 16) {
    const double px = Wrap(curve, 30) - 15;
    const double radius = std::sqrt(px * px + y * y * 0.55);
    if (radius < 4 || (radius > 7.5 && radius < 11)) color = s.second;
  } else if (y > 30 && y < 62 && Triangle(curve + y, 17) > 0.5) {
    color = s.second;
  }
  if (std::fabs(std::fabs(y) - 23) < 2.5) color = {226, 190, 110};
  const double crackle = Weave(hit, 9, s.seed);
  Color lit = Lit(color * (0.72 + 0.55 * crackle), hit);
  const double shine = Smooth(0.93, 1, -0.36 * hit.nx - 0.4 * hit.ny + 0.84 * hit.nz);
  return Mix(lit, {255, 250, 240}, 0.55 * shine);
}

Color PaintLeaf(const Surface& s, const Hit& hit) {
  const double rib = std::fabs(hit.ly);
  const double vein = Triangle(hit.lx - 1.1 * rib, 15 * s.scale);
  const double grain = Weave(hit, 5, s.seed);
  Color color = Mix(s.color, s.second, Smooth(0.72, 1, vein)) * (0.62 + 0.75 * grain);
  if (rib < 1.6) color = s.second;
  // The two halves of a leaf face different directions.
  const double fold = hit.ly > 0 ? 0.82 : 1.08;
  return color * fold;
}

Color PaintBook(const Surface& s, const Hit& hit) {
  const double edge = std::fabs(hit.lx);
  Color color = s.color * (0.7 + 0.55 * Weave(hit, 6, s.seed));
  const double round = 1 - 0.45 * (hit.ly / s.ry) * (hit.ly / s.ry);
  const bool line = std::fabs(hit.ly) < 0.42 * s.ry;
  if (edge > 0.8 * s.rx && edge < 0.86 * s.rx) return s.second * round;
  if (line && edge < 0.62 * s.rx) {
    // Imitates letters by strokes of random height in cells of 8 units, with gaps between words.
    const int32_t cell = static_cast<int32_t>(std::floor(hit.lx / 8));
    const double px = Wrap(hit.lx, 8);
    const uint32_t form = Hash(cell, 5, s.seed);
    const bool space = form % 6u == 0;
    const bool upright = px > 1 && px < 2.8, bar = std::fabs(hit.ly - 3 + (form % 7u)) < 1.1;
    const bool stroke = upright || (bar && px < 6) || ((form & 64u) != 0 && px > 4.4 && px < 6.2);
    if (!space && stroke) color = s.second;
  }
  return color * round;
}

Color PaintLandscape(const Surface& s, const Hit& hit) {
  const double x = hit.lx, y = hit.ly;
  const double frame_x = s.rx - std::fabs(x), frame_y = s.ry - std::fabs(y);
  const double border = frame_x < frame_y ? frame_x : frame_y;
  if (border < 13) {
    const double carving = Triangle(frame_x < frame_y ? y : x, 9) * Smooth(0, 6, border);
    return Mix(s.color, s.second, 0.5 * carving + 0.5 * Noise(x / 3, y / 3, s.seed));
  }
  if (border < 24) return Color{228, 220, 202} * (0.82 + 0.25 * Weave(hit, 4, s.seed + 1));
  const double brush = Fractal(x / 14, y / 5, 4, s.seed + 2);
  const double sx = x + 30, sy = y + 22;
  if (sx * sx + sy * sy < 220) return Color{250, 226, 150} * (0.75 + 0.4 * brush);
  const double far_hill = 2 + 26 * Noise(x / 34, 0, s.seed + 3);
  const double near_hill = 24 + 22 * Noise(x / 26, 3, s.seed + 4);
  Color color = Mix({224, 150, 112}, {92, 118, 170}, Clamp01(0.5 - y / 110));
  if (y > far_hill) color = {78, 96, 128};
  if (y > near_hill) color = {62, 92, 58};
  return color * (0.6 + 0.8 * brush);
}

Color PaintBulb(const Surface& s, const Hit& hit) {
  const double square = (hit.lx * hit.lx + hit.ly * hit.ly) / (s.rx * s.rx);
  const double filament = Noise(hit.lx / 2, hit.ly / 2, s.seed);
  return Mix(Color{255, 252, 236} * (0.94 + 0.06 * filament), s.color, Smooth(0.3, 1, square));
}

Color PaintMatter(const Surface& s, const Hit& hit) {
  const Color color = Mix(s.color, s.second, Smooth(0.35, 0.65, Weave(hit, 5 * s.scale, s.seed)));
  return s.shape == Shape::kEllipsoid ? Lit(color, hit) : color;
}

Color PaintLamp(const Surface& s, const Hit& hit) {
  const double out = (hit.lx / s.rx) * (hit.lx / s.rx) + (hit.ly / s.ry) * (hit.ly / s.ry);
  return Mix(s.color, s.second, Smooth(0.4, 1, out));
}

}  // namespace starfocus
