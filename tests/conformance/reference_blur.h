// SPDX-License-Identifier: Apache-2.0
// PSF (4) of the reference, integrated over pixels. The reference uses this PSF for the blur
// mode, and for cells that block mode blurs without rendering views.
#ifndef STARFOCUS_TESTS_CONFORMANCE_REFERENCE_BLUR_H_
#define STARFOCUS_TESTS_CONFORMANCE_REFERENCE_BLUR_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "tests/conformance/reference_line.h"

namespace reference {

inline constexpr int kOne = 64;  // number of units of disparity or radius per pixel

// Returns the distance between neighbouring radii of stored PSFs (lib/optics/psf.h), at a radius
// in 1/kOne pixels. The distance is 1/8 pixel up to a radius of 4 pixels. Beyond 4 pixels, the
// distance is 1/32 of the start of each octave.
inline double LadderUnit(int radius) {
  double unit = kOne / 8.0;
  for (double octave = 4 * kOne; radius >= octave; octave *= 2) unit = octave / 32;
  return unit;
}

// Returns, in pixels, the radius of a stored PSF that is nearest to `radius` (in 1/kOne pixels).
inline double NearestRadius(int radius) {
  const double unit = LadderUnit(radius);
  return std::floor(radius / unit + 0.5) * unit / kOne;
}

// Returns the number of lines, or of points along an axis, for integrating over a square of the
// unit disc. With the returned number, dark pixels next to white pixels are exact to one code of
// sRGB.
inline int FinenessOf(double side) { return std::clamp(int(600 * side), 40, 600); }

// Integrates the aperture density of equation (3) over [x0, x1] x [y0, y1] in the plane of the unit
// disc. The sum over lines of y uses the midpoint rule along each line and ends exactly on the rim
// of the disc. A `cot_square` of 0 selects a disc of constant brightness.
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

// Ideal PSF (4), scaled to a sum of 1.
struct Psf {
  int size = 0;
  std::vector<double> weights;  // (2 * size + 1)^2 weights
  double At(int n, int m) const {
    return weights[size_t(m + size) * size_t(2 * size + 1) + size_t(n + size)];
  }
};

// Returns the light that passes the square [x0, x1] x [y0, y1] of the opening. Polygons are sampled
// at points.
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

// Returns the integrals over pixels of a disc of radius r, scaled to a sum of 1.
inline Psf Integrals(double r, const ApertureShape& opening) {
  Psf psf;
  psf.size = int(std::ceil(r + 0.5));
  double sum = 0;
  ForEachAround(psf.size, [&](int n, int m) {
    psf.weights.push_back(
        LightOf(opening, (n - 0.5) / r, (n + 0.5) / r, (m - 0.5) / r, (m + 0.5) / r));
    sum += psf.weights.back();
  });
  for (double& weight : psf.weights) weight /= sum;
  return psf;
}

// Returns the mean of the variances of a PSF along both axes.
inline double Variance(const Psf& psf) {
  double squares = 0;
  ForEachAround(psf.size, [&](int n, int m) { squares += psf.At(n, m) * (n * n + m * m); });
  return squares / 2;
}

// Returns the PSF of radius r. Pixels of a picture are integrals over pixels already, so the
// variance of the PSF exceeds the variance of the blur only by a quarter, or by 1/24 of a pixel. To
// this end, small PSFs are a mixture of integrals with an unblurred pixel, and large PSFs are
// integrals of a smaller disc.
inline Psf MakePsf(double r, const ApertureShape& opening) {
  if (r == 0) return {0, {1}};
  // In the integrals of a large disc, the pixels add 1/12 to the variance.
  constexpr double kLarge = 16;
  const double mean = (Variance(Integrals(kLarge, opening)) - 1.0 / 12) / (kLarge * kLarge);
  const double variance = r * r * mean;
  if (variance >= 0.5) return Integrals(std::sqrt(r * r - 1 / (24 * mean)), opening);
  Psf psf = Integrals(std::max(r, 0.8), opening);
  const double share = std::min(1.0, (variance + std::min(variance / 4, 1.0 / 24)) / Variance(psf));
  for (double& weight : psf.weights) weight *= share;
  psf.weights[psf.weights.size() / 2] += 1 - share;
  return psf;
}

// Returns the PSF of MakePsf from a cache. The returned reference is valid until the next call.
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
