// SPDX-License-Identifier: Apache-2.0
// Computes the two integrals that examples/lab/analysis uses for continuous quantities.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_INTEGRAL_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_INTEGRAL_H_

#include <cmath>

namespace starfocus::analysis {

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

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_INTEGRAL_H_
