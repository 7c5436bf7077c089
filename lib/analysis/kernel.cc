// SPDX-License-Identifier: Apache-2.0
#include "lib/analysis/kernel.h"

#include <algorithm>
#include <numeric>

namespace starfocus::analysis {

double Kernel1::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void Kernel1::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double Kernel::Sum() const { return std::accumulate(taps_.begin(), taps_.end(), 0.0); }

void Kernel::Scale(double factor) {
  for (double& tap : taps_) tap *= factor;
}

double SquaredError(const Kernel& a, const Kernel& b) {
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

double SquaredError(const Kernel1& a, const Kernel1& b) {
  const int radius = std::max(a.radius(), b.radius());
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) sum += (a(n) - b(n)) * (a(n) - b(n));
  return sum;
}

double Energy(const Kernel& kernel) { return SquaredError(kernel, Kernel(0)); }

}  // namespace starfocus::analysis
