// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/sampled_psf.h"

#include <algorithm>
#include <numeric>

namespace starfocus::analysis {

double Taps::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void Taps::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double SampledPsf::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void SampledPsf::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double SquaredError(const SampledPsf& a, const SampledPsf& b) {
  const int radius = std::max(a.radius(), b.radius());
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) {
    for (int m = -radius; m <= radius; ++m) {
      const double difference = a(n, m) - b(n, m);
      sum += difference * difference;
    }
  }
  return sum;
}

double SquaredError(const Taps& a, const Taps& b) {
  const int radius = std::max(a.radius(), b.radius());
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) sum += (a(n) - b(n)) * (a(n) - b(n));
  return sum;
}

double Energy(const SampledPsf& psf) { return SquaredError(psf, SampledPsf(0)); }

}  // namespace starfocus::analysis
