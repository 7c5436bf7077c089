// SPDX-License-Identifier: Apache-2.0
// Computes the number of views that a blur radius requires according to the paper's criteria
// (III-C, Fig. 6). The paper derives its rule (9) for the number of views from the criteria of
// section III-C.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SELECTION_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SELECTION_H_

#include "examples/lab/analysis/view_psf.h"

namespace starfocus::analysis {

// The paper's epsilon: the largest permitted SSE (8) between a PSF and the ideal PSF.
inline constexpr double kThreshold = 1e-3;

// PaperError returns the SSE (8) of the paper's PSF, and SubapertureError the SSE (8) of the PSF of
// subapertures.
double PaperError(double r, int n, double theta, Rim rim = Rim::kIncluded);
double SubapertureError(double r, int n, double theta);

// One point of the curve in the paper's Fig. 6.
struct RatioPoint {
  double ratio;  // Number of views along the radius, divided by the blur radius: N / r.
  double error;  // SSE (8) between the PSF of N views and the ideal PSF.
};

// Returns the over-sampling ratio (1 <= N / r <= 2) with the largest error, marked by 'o' in Fig.
// 6. The curve of Fig. 6 has a cusp at N / r = 3 / 2.
RatioPoint WorstOverSampling(int n, double theta, Rim rim = Rim::kIncluded);

// Returns the under-sampling ratio (N / r < 1) marked by the triangle in Fig. 6: the largest ratio
// below 1 whose error equals `error`. Returns 0 if no ratio above 1 / 4 has an error equal to
// `error`.
double UnderSamplingRatio(int n, double theta, double error, Rim rim = Rim::kIncluded);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SELECTION_H_
