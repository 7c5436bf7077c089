// SPDX-License-Identifier: Apache-2.0
// How many views a blur radius needs by the paper's criteria (III-C, Fig. 6): what (9) rests on.
#ifndef STARFOCUS_LIB_ANALYSIS_SELECTION_H_
#define STARFOCUS_LIB_ANALYSIS_SELECTION_H_

#include "lib/analysis/view_psf.h"

namespace starfocus::analysis {

// The paper's epsilon: a blur may differ from the ideal one by this SSE.
inline constexpr double kThreshold = 1e-3;

// The SSE (8) of the paper's PSF, and of the PSF of subapertures.
double PaperError(double r, int n, double theta, Rim rim = Rim::kIncluded);
double SubapertureError(double r, int n, double theta);

// A point of Fig. 6.
struct RatioPoint {
  double ratio;  // N / r
  double error;  // (8)
};

// Over-sampling (1 <= N / r <= 2) with the largest error: the 'o' of Fig. 6. The curve has a cusp
// at N / r = 3 / 2.
RatioPoint WorstOverSampling(int n, double theta, Rim rim = Rim::kIncluded);

// Under-sampling (N / r < 1): the first ratio below 1 whose error is `error`, the triangle of
// Fig. 6. 0 when there is none above 1 / 4.
double UnderSamplingRatio(int n, double theta, double error, Rim rim = Rim::kIncluded);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SELECTION_H_
