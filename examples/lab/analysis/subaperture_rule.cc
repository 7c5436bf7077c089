// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/analysis/subaperture_rule.h"

#include <algorithm>
#include <cmath>

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/subsampled.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/optics/rules.h"

namespace starfocus::analysis {

int FewestSubapertures(double r, double theta) {
  const double limit = PaperError(r, ViewsByPaper(r), theta);
  int n = 0;
  while (SubapertureError(r, n, theta) > limit) ++n;
  return n;
}

double WorstOfLens(int lens, double r_max, double theta) {
  constexpr double kFirst = 0.625, kStep = 0.5;
  const SubapertureLights lights = SubapertureLights::OfLens(lens, theta);
  double worst = 0;
  for (double r = kFirst; r <= r_max; r += kStep) {
    worst = std::max(worst, SquaredError(SubaperturePsf(r, lights), IdealPsf(r, theta)));
  }
  return worst;
}

SubapertureStudy::SubapertureStudy(double r_limit, double step, double theta)
    : step_(step), theta_(theta) {
  for (int k = 1; k * step <= r_limit; ++k) ideal_.push_back(IdealPsf(k * step, theta));
}

double SubapertureStudy::Margin(int k_max, int n, double* worst) {
  const std::vector<double>& subapertures = SubapertureErrors(n);
  const int paper_n = ViewsByPaper(Radius(k_max));
  const std::vector<double>& paper = PaperErrors(paper_n);
  const double over = over_sampling_[static_cast<size_t>(paper_n)];
  double largest = 0;
  for (size_t k = 0; k <= static_cast<size_t>(k_max); ++k) {
    const double ratio = subapertures[k] / std::min(kThreshold, std::max(over, paper[k]));
    if (ratio <= largest) continue;
    largest = ratio;
    if (worst != nullptr) *worst = Radius(static_cast<int>(k));
  }
  return largest;
}

int SubapertureStudy::Fewest(int k_max) {
  int n = 0;
  while (Margin(k_max, n) > 1) ++n;
  return n;
}

const std::vector<double>& SubapertureStudy::SubapertureErrors(int n) {
  const size_t index = static_cast<size_t>(n);
  if (subapertures_.size() <= index) subapertures_.resize(index + 1);
  std::vector<double>& errors = subapertures_[index];
  const SubapertureLights lights(n, theta_);
  for (int k = static_cast<int>(errors.size()); k < count(); ++k) {
    const SampledPsf psf = n == 0 ? IdealPsf(0, theta_) : SubaperturePsf(Radius(k), lights);
    errors.push_back(SquaredError(psf, ideal_[static_cast<size_t>(k)]));
  }
  return errors;
}

const std::vector<double>& SubapertureStudy::PaperErrors(int n) {
  const size_t index = static_cast<size_t>(n);
  if (paper_.size() <= index) {
    paper_.resize(index + 1);
    over_sampling_.resize(index + 1);
  }
  std::vector<double>& errors = paper_[index];
  if (errors.empty()) over_sampling_[index] = WorstOverSampling(n, theta_).error;
  for (int k = static_cast<int>(errors.size()); k < count(); ++k) {
    errors.push_back(SquaredError(PaperPsf(Radius(k), n, theta_), ideal_[static_cast<size_t>(k)]));
  }
  return errors;
}

double PaperError(double r, int n, double theta, Rim rim) {
  return SquaredError(PaperPsf(r, n, theta, rim), IdealPsf(r, theta));
}

double SubapertureError(double r, int n, double theta) {
  return SquaredError(SubaperturePsf(r, n, theta), IdealPsf(r, theta));
}

RatioPoint WorstOverSampling(int n, double theta, Rim rim) {
  constexpr int kSteps = 400;  // with 400 steps, 3 / 2 is one of the tested ratios N / r
  const auto error = [&](double ratio) { return PaperError(n / ratio, n, theta, rim); };
  RatioPoint worst = {1, error(1)};
  for (int k = 1; k <= kSteps; ++k) {
    const double ratio = 1 + double(k) / kSteps, at = error(ratio);
    if (at > worst.error) worst = {ratio, at};
  }
  return worst;
}

double UnderSamplingRatio(int n, double theta, double error, Rim rim) {
  constexpr double kStep = 1e-3, kLowest = 0.25;
  const auto excess = [&](double ratio) { return PaperError(n / ratio, n, theta, rim) - error; };
  for (double ratio = 1; ratio > kLowest; ratio -= kStep) {
    if (excess(ratio - kStep) >= 0) return Cross(ratio - kStep, ratio, 1e-7, excess);
  }
  return 0;
}

}  // namespace starfocus::analysis
