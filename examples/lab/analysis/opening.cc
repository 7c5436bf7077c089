// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/opening.h"

#include <algorithm>
#include <cmath>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/optics/view_weights.h"

namespace starfocus::analysis {
namespace {

constexpr double kBetaDown = 1.28;  // as in kDownFilter

// Returns the share of a square that is open. The square has sides of `side` and is centred at (u,
// v). The function counts the open points of a grid, unless the whole square is clearly open or
// closed.
double Share(const BrightOpening& opening, double u, double v, double side) {
  constexpr int kPoints = 64;
  int corners = 0;
  for (const double du : {-0.5, 0.5}) {
    for (const double dv : {-0.5, 0.5}) corners += opening.Contains(u + du * side, v + dv * side);
  }
  const double reach = side / std::sqrt(2.0), middle = std::hypot(u, v);
  if (opening.inner == 0 && corners == 4) return 1;
  if (middle - reach > 1) return 0;
  int inside = 0;
  for (int point = 0; point < kPoints * kPoints; ++point) {
    const double du = (point % kPoints + 0.5) / kPoints - 0.5;
    const double dv = (point / kPoints + 0.5) / kPoints - 0.5;
    inside += opening.Contains(u + du * side, v + dv * side) ? 1 : 0;
  }
  return double(inside) / (kPoints * kPoints);
}

}  // namespace

bool BrightOpening::Contains(double u, double v) const {
  const double square = u * u + v * v;
  if (square > 1 || square < inner * inner) return false;
  for (int k = 0; k < blades; ++k) {
    const double angle = (2 * k + 1) * kPi / blades;
    if (u * std::sin(angle) - v * std::cos(angle) > std::cos(kPi / blades)) return false;
  }
  return true;
}

SampledPsf IdealPsf(double r, const BrightOpening& opening) {
  SampledPsf psf(static_cast<int>(std::ceil(r + 0.5)));
  for (int n = -psf.radius(); n <= psf.radius(); ++n) {
    for (int m = -psf.radius(); m <= psf.radius(); ++m) {
      psf.at(n, m) = Share(opening, n / r, m / r, 1 / r);
    }
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

SampledPsf SubaperturePsf(double r, int n, const BrightOpening& opening) {
  const double lens = double(LensInSubapertures(n)) / kSubapertureUnits;
  const int last = LastSubaperture(n), most = MostOfSubapertures(n);
  const double width = r / lens;  // width of a subaperture in pixels
  SampledPsf psf(static_cast<int>(std::ceil(last * width + (width + 1) / 2)));
  for (int i = -last; i <= last; ++i) {
    for (int j = -last; j <= last; ++j) {
      if (i * i + j * j > most) continue;
      const double light = Share(opening, i / lens, j / lens, 1 / lens);
      const double x = i * width, y = j * width, reach = (width + 1) / 2;
      for (int k = int(std::ceil(x - reach)); k <= int(std::floor(x + reach)); ++k) {
        for (int m = int(std::ceil(y - reach)); m <= int(std::floor(y + reach)); ++m) {
          psf.at(k, m) += light * Trapezoid(k - x, width) * Trapezoid(m - y, width);
        }
      }
    }
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

double WorstOfSubapertures(int n, double r_min, double r_max, const BrightOpening& opening) {
  double worst = 0;
  for (double r = r_min; r <= r_max; r += 0.5) {
    worst = std::max(worst, SquaredError(SubaperturePsf(r, n, opening), IdealPsf(r, opening)));
  }
  return worst;
}

double LayerError(double r, const BrightOpening& opening) {
  return SquaredError(ThroughLayer(IdealPsf(r / 2, opening), kBetaDown), IdealPsf(r, opening));
}

}  // namespace starfocus::analysis
