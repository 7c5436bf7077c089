// SPDX-License-Identifier: Apache-2.0
// The aperture (3) and the ideal PSF (4), the integrals that both use, and the sampled PSFs and
// filters of the analysis with their squared differences.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_

#include <cmath>
#include <cstddef>
#include <vector>

namespace starfocus::analysis {

// Taps b[n] of a 1D filter for |n| <= radius. Taps with |n| > radius are zero.
class Taps {
 public:
  explicit Taps(int radius) : radius_(radius), taps_(static_cast<size_t>(2 * radius + 1)) {}

  int radius() const { return radius_; }
  double& at(int n) { return taps_[static_cast<size_t>(n + radius_)]; }
  double operator()(int n) const {
    return n < -radius_ || n > radius_ ? 0 : taps_[static_cast<size_t>(n + radius_)];
  }
  double Sum() const;
  void Scale(double factor);

 private:
  int radius_;
  std::vector<double> taps_;
};

// Taps b[n, m] of a 2D PSF for |n|, |m| <= radius. Taps with |n| or |m| > radius are zero.
class SampledPsf {
 public:
  explicit SampledPsf(int radius)
      : radius_(radius), taps_(static_cast<size_t>(2 * radius + 1) * (2 * radius + 1)) {}

  int radius() const { return radius_; }
  double& at(int n, int m) { return taps_[Index(n, m)]; }
  double operator()(int n, int m) const {
    const bool inside = n >= -radius_ && n <= radius_ && m >= -radius_ && m <= radius_;
    return inside ? taps_[Index(n, m)] : 0;
  }
  double Sum() const;
  void Scale(double factor);

 private:
  size_t Index(int n, int m) const {
    return static_cast<size_t>(n + radius_) * (2 * radius_ + 1) + static_cast<size_t>(m + radius_);
  }

  int radius_;
  std::vector<double> taps_;
};

// Returns the sum of squared differences between two PSFs, as in (8) and (10).
double SquaredError(const SampledPsf& a, const SampledPsf& b);
double SquaredError(const Taps& a, const Taps& b);

// Returns the sum of the squared taps, as in (11).
double Energy(const SampledPsf& psf);

// Computes the aperture filter (3): the cosine-fourth fall-off of a lens.

inline constexpr double kPi = 3.14159265358979323846;

// Default fall-off of the paper, from Table I at r = 3.
inline constexpr double kDefaultTheta = 0.26 * kPi;

// Returns cot^2(theta), the only form in which theta enters (3).
double FallOff(double theta);

// Returns a(u, v; theta) at u^2 + v^2 = square. The function a has an integral of 1 over the unit
// disc, and is 0 outside the disc.
double Aperture(double square, double theta);

// Returns the 1D aperture of Figs. 4, 5 and 8: a(u, 0; theta), scaled to an integral of 1 over [-1,
// 1].
double Aperture1(double u, double theta);

// Computes the two integrals that examples/lab/analysis uses for continuous quantities.

// Returns the integral of 1 / (x^2 + c)^2 over [low, high], c > 0.
inline double InverseSquare(double low, double high, double c) {
  const double root = std::sqrt(c);
  const auto primitive = [&](double x) {
    return x / (2 * c * (x * x + c)) + std::atan(x / root) / (2 * c * root);
  };
  return primitive(high) - primitive(low);
}

// Integrates a smooth f over [low, high] by Gauss-Legendre quadrature with 8 points.
template <class Function>
double Integrate(double low, double high, const Function& f) {
  constexpr double kPoints[] = {0.18343464249564980, 0.52553240991632899, 0.79666647741362674,
                                0.96028985649753623};
  constexpr double kWeights[] = {0.36268378337836198, 0.31370664587788729, 0.22238103445337447,
                                 0.10122853629037626};
  const double middle = (low + high) / 2, half = (high - low) / 2;
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    sum += kWeights[i] * (f(middle - half * kPoints[i]) + f(middle + half * kPoints[i]));
  }
  return half * sum;
}

// Computes the discrete PSF of the ideal defocus blur (4).

// Returns (4) for a blur radius r >= 0 in pixels, with an error of about 1e-12. For r = 0, returns
// the unit impulse.
SampledPsf IdealPsf(double r, double theta);

// Returns the ideal PSF of the 1D aperture, with an error of about 1e-12.
Taps IdealPsf1(double r, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_
