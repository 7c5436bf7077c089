// SPDX-License-Identifier: Apache-2.0
// Computes frequency responses of 1D PSFs (Figs. 5 and 8 of the paper).
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SPECTRUM_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SPECTRUM_H_

#include <cmath>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Returns B(e^{j omega}) of a symmetric PSF, which is real.
inline double Response(const Taps& psf, double omega) {
  double sum = psf(0);
  for (int n = 1; n <= psf.radius(); ++n) sum += 2 * psf(n) * std::cos(n * omega);
  return sum;
}

// Returns H(f) = sinc^2(f) of the triangular h.
inline double TriangleResponse(double f) {
  if (f == 0) return 1;
  const double sinc = std::sin(kPi * f) / (kPi * f);
  return sinc * sinc;
}

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SPECTRUM_H_
