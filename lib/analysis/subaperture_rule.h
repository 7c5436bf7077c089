// SPDX-License-Identifier: Apache-2.0
// The rule (9) for subapertures: the number of views that a blur radius needs if each view stands
// for its part of the lens.
#ifndef STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_
#define STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_

#include <vector>

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// The rule is ViewsBySubaperture of lib/base/rules.h. Up to half a pixel the ideal PSF (4) is the
// unit impulse, so the centre view alone is exact. For larger radii, two limits hold for every r <=
// r_max. The SSE (8) is below 10^-3. It is also below the larger of two errors of the paper's N by
// (9): the SSE of its PSF at the same r, and its worst over-sampling SSE. The latter is (9)'s own
// limit. SubapertureStudy::Margin measures both.

// Returns the smallest N whose subapertures are at least as good at r as the paper's PSF with N
// from (9).
int FewestSubapertures(double r, double theta);

// Returns the largest SSE (8) of the PSF of a lens that is `lens` / kSubapertureUnits subapertures
// wide. The radii are from 5/8 of a pixel (below, only the centre view is rendered) to r_max.
// LensInSubapertures is chosen to keep this error small.
double WorstOfLens(int lens, double r_max, double theta);

// Errors of the PSFs at every r, used to search for rules.
class SubapertureStudy {
 public:
  // Computes the ideal PSFs for r = k * step, 0 < r <= r_limit.
  SubapertureStudy(double r_limit, double step, double theta);

  int count() const { return static_cast<int>(ideal_.size()); }
  double Radius(int k) const { return (k + 1) * step_; }  // k in [0, count())

  // Returns the largest ratio of the subapertures' error to the limit of ViewsBySubaperture, over
  // all r <= Radius(k_max). The rule holds if it is at most 1. `worst`, if not null, receives the r
  // of that ratio.
  double Margin(int k_max, int n, double* worst = nullptr);

  // Returns the smallest N for which Margin is at most 1.
  int Fewest(int k_max);

 private:
  const std::vector<double>& SubapertureErrors(int n);
  const std::vector<double>& PaperErrors(int n);

  double step_, theta_;
  std::vector<SampledPsf> ideal_;
  std::vector<std::vector<double>> subapertures_, paper_;  // by N; empty until used
  std::vector<double> over_sampling_;                      // of each N of paper_
};

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_
