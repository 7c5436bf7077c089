// SPDX-License-Identifier: Apache-2.0
// Paints the test patterns of the scenes `wires`, `ramp`, `hair` and `grass`.
#include <cmath>

#include "examples/scene/noise.h"
#include "examples/scene/textures.h"

namespace starfocus {
namespace {

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
  const double cloud = Fractal(hit.x / 22, hit.y / 22, 5, s.seed);
  const double bend = 34 * Fractal(hit.x / 60, hit.y / 60, 4, s.seed + 7);
  const double crack = Triangle(hit.x + bend, 46);
  const Color color = Mix(s.color, s.second, cloud);
  return color * (0.25 + 0.75 * Smooth(0.1, 0.22, crack));
}

Color PaintFloor(const Surface& s, const Hit& hit) {
  const double cell = 52;
  const double cx = std::floor(hit.x / cell), cy = std::floor(hit.y / cell);
  const int32_t ix = static_cast<int32_t>(cx), iy = static_cast<int32_t>(cy);
  const double px = Wrap(hit.x, cell), py = Wrap(hit.y, cell);
  if (px < 2.5 || py < 2.5) return Color{70, 64, 60} * (0.7 + 0.6 * Noise(hit.x, hit.y, s.seed));
  const double tint = HashUnit(ix, iy, s.seed + 1);
  const double veins = Fractal(hit.x / 17 + 20 * tint, hit.y / 17, 5, s.seed + 2);
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
