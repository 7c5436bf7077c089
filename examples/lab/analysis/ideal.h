// SPDX-License-Identifier: Apache-2.0
// Computes the discrete PSF of the ideal defocus blur (4).
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_

#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Returns (4) for a blur radius r >= 0 in pixels, with an error of about 1e-12. For r = 0, returns
// the unit impulse.
SampledPsf IdealPsf(double r, double theta);

// Returns the ideal PSF of the 1D aperture, with an error of about 1e-12.
Taps IdealPsf1(double r, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_IDEAL_H_
