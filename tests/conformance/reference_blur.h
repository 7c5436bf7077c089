// SPDX-License-Identifier: Apache-2.0
// The reference's ideal kernel (4) over pixels, for the blur mode and for what block mode gathers.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_BLUR_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_BLUR_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "tests/conformance/reference_opening.h"

namespace reference {

inline constexpr int kOne = 64;  // of disparities and radii

// A step, at a radius in 1 / kOne pixels, of the ladder that blur.h describes: 1/8 pixel up to 4
// pixels, 1/32 of each octave's beginning beyond.
inline double LadderUnit(int radius) {
  double unit = kOne / 8.0;
  for (double octave = 4 * kOne; radius >= octave; octave *= 2) unit = octave / 32;
  return unit;
}

// Its nearest radius to one in 1 / kOne pixels, in pixels.
inline double NearestRadius(int radius) {
  const double unit = LadderUnit(radius);
  return std::floor(radius / unit + 0.5) * unit / kOne;
}

// Lines, or points along an axis, of a part of the unit disc: so many that the dark beside white is
// right to a code of sRGB.
inline int FinenessOf(double side) { return std::clamp(int(600 * side), 40, 600); }

// Integral of (3) over [x0, x1] x [y0, y1] of the unit disc's plane, by lines of y and the midpoint
// rule along them, which ends on the disc's rim exactly.
// `cot_square` 0: of a disc as bright everywhere.
inline double Integral(double x0, double x1, double y0, double y1, double cot_square) {
  constexpr int kPoints = 24;
  y0 = std::max(y0, -1.0);
  y1 = std::min(y1, 1.0);
  if (y0 >= y1) return 0;
  const int lines = FinenessOf(y1 - y0);
  double sum = 0;
  for (int line = 0; line < lines; ++line) {
    const double y = y0 + (line + 0.5) / lines * (y1 - y0);
    const double rim = std::sqrt(1 - y * y), from = std::max(x0, -rim), to = std::min(x1, rim);
    if (from >= to) continue;
    for (int point = 0; point < kPoints; ++point) {
      const double x = from + (point + 0.5) / kPoints * (to - from);
      const double ratio = cot_square == 0 ? 1 : cot_square / (x * x + y * y + cot_square);
      sum += ratio * ratio * (to - from) / kPoints;
    }
  }
  return sum * (y1 - y0) / lines;
}

// (4), summing to 1.
struct Psf {
  int size = 0;
  std::vector<double> weights;  // (2 size + 1)^2
  double At(int n, int m) const {
    return weights[size_t(m + size) * size_t(2 * size + 1) + size_t(n + size)];
  }
};

// The light of the opening's square [x0, x1] x [y0, y1]; a polygon's by points.
inline double LightOf(const ApertureShape& opening, double x0, double x1, double y0, double y1) {
  if (opening.shape == STARFOCUS_SHAPE_FALL_OFF) return Integral(x0, x1, y0, y1, opening.cot2);
  if (opening.shape == STARFOCUS_SHAPE_POLYGON) {
    const int points = FinenessOf(x1 - x0);
    double sum = 0;
    for (int point = 0; point < points * points; ++point) {
      sum += opening.Density(x0 + (point % points + 0.5) / points * (x1 - x0),
                             y0 + (point / points + 0.5) / points * (y1 - y0));
    }
    return sum / (points * points) * (x1 - x0) * (y1 - y0);
  }
  double light = Integral(x0, x1, y0, y1, 0);
  const double r = opening.inner;
  if (opening.shape == STARFOCUS_SHAPE_RING && r > 0) {
    light -= r * r * Integral(x0 / r, x1 / r, y0 / r, y1 / r, 0);
  }
  return light;
}

inline Psf MakePsf(double r, const ApertureShape& opening) {
  Psf kernel;
  if (r == 0) {
    kernel.weights = {1};
    return kernel;
  }
  kernel.size = int(std::ceil(r + 0.5));
  double sum = 0;
  for (int m = -kernel.size; m <= kernel.size; ++m) {
    for (int n = -kernel.size; n <= kernel.size; ++n) {
      const double weight =
          LightOf(opening, (n - 0.5) / r, (n + 0.5) / r, (m - 0.5) / r, (m + 0.5) / r);
      kernel.weights.push_back(weight);
      sum += weight;
    }
  }
  for (double& weight : kernel.weights) weight /= sum;
  return kernel;
}

// The kernel of MakePsf, made once for all calls that ask for it; good until the next call.
inline const Psf& PsfOf(double r, const ApertureShape& opening) {
  static std::map<std::array<double, 7>, Psf> kernels;
  constexpr size_t kMost = 1000;
  const std::array<double, 7> key = {r,
                                     opening.theta,
                                     double(opening.shape),
                                     double(opening.blades),
                                     opening.rotation,
                                     opening.curvature,
                                     opening.inner};
  auto found = kernels.find(key);
  if (found == kernels.end()) {
    if (kernels.size() >= kMost) kernels.clear();
    found = kernels.emplace(key, MakePsf(r, opening)).first;
  }
  return found->second;
}

}  // namespace reference

#endif  // STARFOCUS_TESTS_CONFORMANCE_REFERENCE_BLUR_H_
