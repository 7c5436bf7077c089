// SPDX-License-Identifier: Apache-2.0
// Finds minima and sign changes of functions of one variable.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SEARCH_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SEARCH_H_

namespace starfocus::analysis {

// Returns the position of the minimum of f in [low, high], by golden-section search to `tolerance`.
// The function f must have a single local minimum in [low, high].
template <class Function>
double Minimise(double low, double high, double tolerance, const Function& f) {
  constexpr double kGolden = 0.61803398874989485;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = f(a), at_b = f(b);
  while (high - low > tolerance) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = f(b);
    }
  }
  return (low + high) / 2;
}

// Returns the position of a sign change of f in [low, high], by bisection to `tolerance`.
template <class Function>
double Cross(double low, double high, double tolerance, const Function& f) {
  const bool positive = f(low) > 0;
  while (high - low > tolerance) {
    const double middle = (low + high) / 2;
    ((f(middle) > 0) == positive ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SEARCH_H_
