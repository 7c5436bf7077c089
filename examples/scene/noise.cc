// SPDX-License-Identifier: Apache-2.0
#include "examples/scene/noise.h"

namespace starfocus {
namespace {

// Returns std::floor(x) for |x| below 2^63. Compiles to instructions that every x86-64 processor
// has, instead of a function call.
double Floor(double x) {
  const double whole = static_cast<double>(static_cast<int64_t>(x));
  return whole - (whole > x ? 1 : 0);
}

}  // namespace

uint32_t Hash(int32_t x, int32_t y, uint32_t seed) {
  uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
               seed * 0xcb1ab31fu;
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  h ^= h >> 16;
  return h;
}

double HashUnit(int32_t x, int32_t y, uint32_t seed) { return Hash(x, y, seed) * 0x1p-32; }

double Noise(double x, double y, uint32_t seed) {
  const double floor_x = Floor(x), floor_y = Floor(y);
  const double fx = x - floor_x, fy = y - floor_y;
  const int32_t ix = static_cast<int32_t>(floor_x), iy = static_cast<int32_t>(floor_y);
  const double sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
  const double a = HashUnit(ix, iy, seed), b = HashUnit(ix + 1, iy, seed);
  const double c = HashUnit(ix, iy + 1, seed), d = HashUnit(ix + 1, iy + 1, seed);
  const double top = a + (b - a) * sx, bottom = c + (d - c) * sx;
  return top + (bottom - top) * sy;
}

double Fractal(double x, double y, int octaves, uint32_t seed) {
  double sum = 0, weight = 1, total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * Noise(x, y, seed + static_cast<uint32_t>(i) * 101u);
    total += weight;
    weight *= 0.5;
    // Halve the size and rotate by a Pythagorean angle (3-4-5), so that the lattices do not align.
    const double turned = 2 * (0.8 * x - 0.6 * y);
    y = 2 * (0.6 * x + 0.8 * y);
    x = turned;
  }
  return sum / total;
}

double Wrap(double x, double period) { return x - period * Floor(x / period); }

double Triangle(double x, double period) {
  const double phase = Wrap(x, period) / period;
  return phase < 0.5 ? 2 * phase : 2 - 2 * phase;
}

double Smooth(double low, double high, double x) {
  const double t = Clamp01((x - low) / (high - low));
  return t * t * (3 - 2 * t);
}

}  // namespace starfocus
