// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/analysis/ideal.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace starfocus::analysis {

double Taps::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void Taps::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double SampledPsf::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void SampledPsf::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double SquaredError(const SampledPsf& a, const SampledPsf& b) {
  const int radius = std::max(a.radius(), b.radius());
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) {
    for (int m = -radius; m <= radius; ++m) {
      const double difference = a(n, m) - b(n, m);
      sum += difference * difference;
    }
  }
  return sum;
}

double SquaredError(const Taps& a, const Taps& b) {
  const int radius = std::max(a.radius(), b.radius());
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) sum += (a(n) - b(n)) * (a(n) - b(n));
  return sum;
}

double Energy(const SampledPsf& psf) { return SquaredError(psf, SampledPsf(0)); }

double FallOff(double theta) {
  const double tangent = std::tan(theta);
  return 1 / (tangent * tangent);
}

double Aperture(double square, double theta) {
  if (square > 1) return 0;
  const double c = FallOff(theta), cosine = std::cos(theta);
  return c * c / (kPi * cosine * cosine * (square + c) * (square + c));
}

double Aperture1(double u, double theta) {
  if (std::fabs(u) > 1) return 0;
  const double c = FallOff(theta), denominator = u * u + c;
  return 1 / (denominator * denominator) / InverseSquare(-1, 1, c);
}

namespace {

// Longest interval, in radians, that one quadrature covers.
constexpr double kLongestPiece = 0.4;

int RadiusOf(double r) { return static_cast<int>(std::ceil(r + 0.5)); }

// Returns the angles in [low, high] at which the circle of radius r crosses the pixel's left or
// right side. The integrand of Pixel is smooth between two adjacent crossings.
std::vector<double> Breaks(double low, double high, double left, double right, double r) {
  std::vector<double> breaks = {low, high};
  for (const double x : {left, right}) {
    if (std::fabs(x) >= r) continue;
    const double angle = std::acos(std::fabs(x) / r);
    for (const double at : {-angle, angle}) {
      if (at > low && at < high) breaks.push_back(at);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  return breaks;
}

// Returns the integral of (4) over the pixel [n - 1/2, n + 1/2] x [m - 1/2, m + 1/2]. The integral
// along x has a closed form. Along y, the substitution y = r sin(phi) removes the singularity at
// the edge of the disc.
double Pixel(int n, int m, double r, double theta) {
  const double bottom = std::max(m - 0.5, -r), top = std::min(m + 0.5, r);
  if (bottom >= top) return 0;
  const double c = FallOff(theta), cosine = std::cos(theta);
  const double left = n - 0.5, right = n + 0.5;
  const auto slice = [&](double phi) {
    const double y = r * std::sin(phi), chord = r * std::cos(phi);
    const double low = std::max(left, -chord), high = std::min(right, chord);
    return low < high ? chord * InverseSquare(low, high, y * y + c * r * r) : 0;
  };
  const std::vector<double> breaks =
      Breaks(std::asin(bottom / r), std::asin(top / r), left, right, r);
  double sum = 0;
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    const int pieces = 1 + static_cast<int>(length / kLongestPiece);
    for (int k = 0; k < pieces; ++k) {
      sum +=
          Integrate(breaks[i] + length * k / pieces, breaks[i] + length * (k + 1) / pieces, slice);
    }
  }
  return sum * c * c * r * r / (kPi * cosine * cosine);
}

}  // namespace

SampledPsf IdealPsf(double r, double theta) {
  SampledPsf psf(RadiusOf(r));
  if (r == 0) {
    psf.at(0, 0) = 1;
    return psf;
  }
  for (int n = 0; n <= psf.radius(); ++n) {
    for (int m = 0; m <= n; ++m) {
      const double tap = Pixel(n, m, r, theta);
      for (const int x : {n, -n}) {
        for (const int y : {m, -m}) psf.at(x, y) = psf.at(y, x) = tap;
      }
    }
  }
  return psf;
}

Taps IdealPsf1(double r, double theta) {
  Taps psf(RadiusOf(r));
  if (r == 0) {
    psf.at(0) = 1;
    return psf;
  }
  const double c = FallOff(theta), whole = InverseSquare(-1, 1, c);
  for (int n = -psf.radius(); n <= psf.radius(); ++n) {
    const double low = std::max((n - 0.5) / r, -1.0), high = std::min((n + 0.5) / r, 1.0);
    if (low < high) psf.at(n) = InverseSquare(low, high, c) / whole;
  }
  return psf;
}

}  // namespace starfocus::analysis
