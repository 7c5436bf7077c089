// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/half_band.h"

#include <cmath>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/search.h"

namespace starfocus::analysis {
namespace {

// Returns the modified Bessel function of the first kind, order 0, by its power series.
double Bessel0(double x) {
  double sum = 1, term = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

double Kaiser(int n, double beta) {
  const double place = double(n) / kHalfBandRadius;
  return Bessel0(beta * std::sqrt(1 - place * place)) / Bessel0(beta);
}

double HalfSinc(int n) { return n == 0 ? 1 : std::sin(kPi * n / 2) / (kPi * n / 2); }

}  // namespace

Taps HalfBand(double beta) {
  Taps psf(kHalfBandRadius);
  for (int n = -kHalfBandRadius; n <= kHalfBandRadius; ++n) {
    psf.at(n) = n != 0 && n % 2 == 0 ? 0 : HalfSinc(n) * Kaiser(n, beta);
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

double GainAtPi(const Taps& psf) {
  double gain = 0;
  for (int n = -psf.radius(); n <= psf.radius(); ++n) gain += n % 2 ? -psf(n) : psf(n);
  return gain;
}

double BetaWithoutPi() {
  return Cross(0, 4, 1e-12, [](double beta) { return GainAtPi(HalfBand(beta)); });
}

}  // namespace starfocus::analysis
