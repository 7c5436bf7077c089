// SPDX-License-Identifier: Apache-2.0
// Paints fabrics, skin and hair.
#include "examples/scene/textures.h"

#include <cmath>

#include "examples/scene/noise.h"

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

namespace {

// Paints walls, furniture, plants and lights.

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
  const double weave = 0.5 * (Triangle(hit.lx, 5) + Triangle(hit.ly, 5));
  const double cloud = Fractal(hit.lx / 90, hit.ly / 90, 6, s.seed);
  const Color color = Mix(s.color, s.second, Damask(hit.lx, hit.ly));
  // A lamp outside the picture lights the upper right.
  const double dx = (hit.lx - 260) / 700, dy = (hit.ly + 260) / 620;
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

namespace {

// Paints the test patterns of the scenes `wires`, `ramp`, `hair` and `grass`.

Color Checks(const Surface& s, const Hit& hit, double grain) {
  const double cell = 26 * s.scale;
  const double parity = std::floor(hit.lx / cell) + std::floor(hit.ly / cell);
  const Color color = Wrap(parity, 2) >= 1 ? s.color : s.second;
  return Lit(color * (0.6 + 0.8 * Fractal(hit.lx / grain, hit.ly / grain, 4, s.seed)), hit);
}

}  // namespace

Color PaintChecker(const Surface& s, const Hit& hit) { return Checks(s, hit, 9); }

Color PaintClouds(const Surface& s, const Hit& hit) { return Checks(s, hit, 45); }

Color PaintTwist(const Surface& s, const Hit& hit) {
  const double turn = Triangle(hit.lx + 0.8 * hit.ly, 18 * s.scale);
  const double round = 1 - 0.5 * (hit.ly / s.ry) * (hit.ly / s.ry);
  const double grain = 0.8 + 0.4 * Noise(hit.lx / 3, hit.ly / 3, s.seed);
  return Mix(s.color, s.second, Smooth(0.4, 0.6, turn)) * (round * grain);
}

Color PaintBark(const Surface& s, const Hit& hit) {
  const double cloud = Fractal(hit.lx / 22, hit.ly / 22, 5, s.seed);
  const double bend = 34 * Fractal(hit.lx / 60, hit.ly / 60, 4, s.seed + 7);
  const double crack = Triangle(hit.lx + bend, 46);
  const Color color = Mix(s.color, s.second, cloud);
  return color * (0.25 + 0.75 * Smooth(0.1, 0.22, crack));
}

Color PaintFloor(const Surface& s, const Hit& hit) {
  const double cell = 52;
  const double cx = std::floor(hit.lx / cell), cy = std::floor(hit.ly / cell);
  const int32_t ix = static_cast<int32_t>(cx), iy = static_cast<int32_t>(cy);
  const double px = Wrap(hit.lx, cell), py = Wrap(hit.ly, cell);
  if (px < 2.5 || py < 2.5) return Color{70, 64, 60} * (0.7 + 0.6 * Noise(hit.lx, hit.ly, s.seed));
  const double tint = HashUnit(ix, iy, s.seed + 1);
  const double veins = Fractal(hit.lx / 17 + 20 * tint, hit.ly / 17, 5, s.seed + 2);
  const double vein = Smooth(0.06, 0, std::fabs(veins - 0.5));
  Color color = Wrap(cx + cy, 2) >= 1 ? s.color : s.second;
  color = color * (0.75 + 0.35 * tint) * (0.65 + 0.7 * veins);
  return Mix(color, {242, 236, 224}, 0.6 * vein);
}

Color PaintStrand(const Surface& s, const Hit& hit) {
  const int32_t strand = static_cast<int32_t>(hit.strand);
  const double round = 1 - 0.4 * hit.ly * hit.ly;
  const double grain = 0.7 + 0.6 * Noise(hit.lx / 7, 3.7 * strand, s.seed);
  return Mix(s.color, s.second, HashUnit(strand, 0, s.seed + 1)) * (round * grain);
}

}  // namespace starfocus
