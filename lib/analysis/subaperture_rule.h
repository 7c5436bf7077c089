// SPDX-License-Identifier: Apache-2.0
// The rule (9) redone for subapertures: how many views a blur radius needs when each stands for its
// part of the lens.
#ifndef STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_
#define STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_

#include <vector>

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// The rule is ViewsBySubaperture of lib/rules.h. Up to half a pixel the ideal PSF (4) is the
// unit impulse, so the centre view alone is exact. Beyond, for every r <= r_max, the SSE (8) is
// below 10^-3, and below either that of the paper's PSF with (9)'s N at the same r or the worst
// over-sampling SSE of that N, (9)'s own limit: SubapertureStudy::Margin measures it.

// Least N whose subapertures are no worse at r than the paper's PSF with N from (9).
int FewestSubapertures(double r, double theta);

// The largest SSE (8) of the PSF of a lens `lens` / kSubapertureUnits subapertures wide, over
// the radii from 5/8 of a pixel on (below, the centre view alone is rendered) up to r_max. It is
// what LensInSubapertures keeps small.
double WorstOfLens(int lens, double r_max, double theta);

// Errors of the PSFs at every r, for searching rules.
class SubapertureStudy {
 public:
  // r = k * step, 0 < r <= r_limit.
  SubapertureStudy(double r_limit, double step, double theta);

  int count() const { return static_cast<int>(ideal_.size()); }
  double Radius(int k) const { return (k + 1) * step_; }  // k in [0, count())

  // Largest ratio of the subapertures' error to what ViewsBySubaperture promises, over all r <=
  // r_max; the rule holds when it is at most 1. `worst` receives the r where, when not null.
  double Margin(int k_max, int n, double* worst = nullptr);

  // Least N for which Margin is at most 1.
  int Fewest(int k_max);

 private:
  const std::vector<double>& SubapertureErrors(int n);
  const std::vector<double>& PaperErrors(int n);

  double step_, theta_;
  std::vector<SampledPsf> ideal_;
  std::vector<std::vector<double>> subapertures_, paper_;  // by N; empty until asked for
  std::vector<double> over_sampling_;                      // of each N of paper_
};

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SUBAPERTURE_RULE_H_
