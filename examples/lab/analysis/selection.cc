// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/selection.h"

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/search.h"

namespace starfocus::analysis {

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
