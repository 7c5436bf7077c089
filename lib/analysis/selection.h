// SPDX-License-Identifier: Apache-2.0
// Computes the number of views that a blur radius needs by the paper's criteria (III-C, Fig. 6), on
// which (9) is based.
#ifndef STARFOCUS_LIB_ANALYSIS_SELECTION_H_
#define STARFOCUS_LIB_ANALYSIS_SELECTION_H_

#include "lib/analysis/view_psf.h"

namespace starfocus::analysis {

// The paper's epsilon: largest SSE by which a blur may differ from the ideal one.
inline constexpr double kThreshold = 1e-3;

// Return the SSE (8) of the paper's PSF, and of the PSF of subapertures.
double PaperError(double r, int n, double theta, Rim rim = Rim::kIncluded);
double SubapertureError(double r, int n, double theta);

// A point of Fig. 6.
struct RatioPoint {
  double ratio;  // N / r
  double error;  // (8)
};

// Returns the over-sampling (1 <= N / r <= 2) with the largest error: the 'o' of Fig. 6. The curve
// has a cusp at N / r = 3 / 2.
RatioPoint WorstOverSampling(int n, double theta, Rim rim = Rim::kIncluded);

// Returns the under-sampling (N / r < 1) marked by the triangle of Fig. 6: the first ratio below 1
// whose error is `error`. Returns 0 if no ratio above 1 / 4 has that error.
double UnderSamplingRatio(int n, double theta, double error, Rim rim = Rim::kIncluded);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SELECTION_H_
