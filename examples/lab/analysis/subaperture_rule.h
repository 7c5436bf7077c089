// SPDX-License-Identifier: Apache-2.0
// Computes the counterpart of rule (9) for subapertures. If each view stands for a part of the
// lens, a blur radius requires a different number of views than (9) states.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBAPERTURE_RULE_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBAPERTURE_RULE_H_

#include <vector>

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/view_psf.h"

namespace starfocus::analysis {

// ViewsBySubaperture in lib/optics/rules.h implements the rule for subapertures. Up to a radius of
// half a pixel, the ideal PSF (4) is the unit impulse, so the centre view alone is exact. For
// larger radii, the SSE (8) meets two limits at every r <= r_max. The first limit is an SSE of
// 10^-3. The second limit is the larger of two values for the paper's PSF with N from (9): the SSE
// at r, and the worst SSE of over-sampling. The paper derives (9) from the worst SSE of
// over-sampling. SubapertureStudy::Margin computes the ratio of the error of subapertures to the
// limit of ViewsBySubaperture.

// Returns the smallest N for which subapertures are at least as accurate at r as the paper's PSF
// with N from (9), by their SSE (8).
int FewestSubapertures(double r, double theta);

// Returns the largest SSE (8) of the PSF of a lens that is `lens` / kSubapertureUnits subapertures
// wide. The maximum is taken over radii from 5/8 of a pixel to r_max; for smaller radii, only the
// centre view is rendered. The values of LensInSubapertures keep the largest SSE small.
double WorstOfLens(int lens, double r_max, double theta);

// Errors of the PSFs of subapertures and of the paper at each multiple of a step of r. The lab
// program uses these errors to find rules for N.
class SubapertureStudy {
 public:
  // Computes the ideal PSFs for r = k * step, 0 < r <= r_limit.
  SubapertureStudy(double r_limit, double step, double theta);

  int count() const { return static_cast<int>(ideal_.size()); }
  double Radius(int k) const { return (k + 1) * step_; }  // k in [0, count())

  // Returns the largest ratio of the subapertures' error to the limit of ViewsBySubaperture, over
  // all r <= Radius(k_max). ViewsBySubaperture meets its limit if the largest ratio is at most 1.
  // If `worst` is not null, *worst is set to the r of the largest ratio.
  double Margin(int k_max, int n, double* worst = nullptr);

  // Returns the smallest N for which Margin(k_max, N) is at most 1.
  int Fewest(int k_max);

 private:
  const std::vector<double>& SubapertureErrors(int n);
  const std::vector<double>& PaperErrors(int n);

  double step_, theta_;
  std::vector<SampledPsf> ideal_;
  // Errors, indexed by N; each vector is empty until N is first used.
  std::vector<std::vector<double>> subapertures_, paper_;
  // Worst error of over-sampling, indexed by N.
  std::vector<double> over_sampling_;
};

// Computes the number of views that a blur radius requires according to the paper's criteria
// (III-C, Fig. 6). The paper derives its rule (9) for the number of views from the criteria of
// section III-C.

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

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBAPERTURE_RULE_H_
