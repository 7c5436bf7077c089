// SPDX-License-Identifier: Apache-2.0
// Computes the resampling filters of the subsampled layers: half-band sinc filters with a Kaiser
// window.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_HALF_BAND_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_HALF_BAND_H_

#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

inline constexpr int kHalfBandRadius = 3;  // seven taps

// Parameters of the paper's filters. The value of beta_U is chosen such that G_U(-1) = 0. The value
// of beta_D is that of Table I at r = 3.
inline constexpr double kBetaUp = 2.17;
inline constexpr double kBetaDown = 1.28;

// Returns sinc(n / 2) times the Kaiser window of `beta` >= 0, scaled to a sum of 1.
Taps HalfBand(double beta);

// Returns the gain at the highest frequency, G(e^{j omega}) at omega = pi, of a symmetric filter.
double GainAtPi(const Taps& psf);

// Returns the beta for which GainAtPi(HalfBand(beta)) = 0.
double BetaWithoutPi();

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_HALF_BAND_H_
