#include "lib/analysis/view_kernel.h"

#include <algorithm>
#include <cmath>

#include "lib/analysis/aperture.h"
#include "lib/analysis/ideal.h"

namespace starfocus::analysis {
namespace {

// Calls visit(n) for every whole n within the reach of a footprint at `x`.
template <class Visit>
void ForEachTap(double x, double width, const Visit& visit) {
  const double reach = (width + 1) / 2;
  const int last = static_cast<int>(std::floor(x + reach));
  for (int n = static_cast<int>(std::ceil(x - reach)); n <= last; ++n) visit(n);
}

int RadiusOf(double r, double width) { return static_cast<int>(std::ceil(r + (width + 1) / 2)); }

}  // namespace

double Trapezoid(double t, double width) {
  const double overlap = (1 + width) / 2 - std::fabs(t);
  return std::clamp(overlap, 0.0, std::min(width, 1.0)) / width;
}

Kernel ViewKernel(double r, int n, double theta, double width, Rim rim) {
  const int largest = n * n - (rim == Rim::kExcluded ? 1 : 0);
  Kernel kernel(RadiusOf(r, width));
  for (int i = -n; i <= n; ++i) {
    Kernel1 column(kernel.radius());
    for (int j = -n; j <= n; ++j) {
      if (i * i + j * j > largest) continue;
      const double weight = Aperture(double(i * i + j * j) / (double(n) * n), theta);
      const double y = j * r / n;
      ForEachTap(y, width, [&](int m) { column.at(m) += weight * Trapezoid(m - y, width); });
    }
    const double x = i * r / n;
    ForEachTap(x, width, [&](int k) {
      const double share = Trapezoid(k - x, width);
      for (int m = -kernel.radius(); m <= kernel.radius(); ++m)
        kernel.at(k, m) += share * column(m);
    });
  }
  kernel.Scale(1 / kernel.Sum());
  return kernel;
}

Kernel PaperKernel(double r, int n, double theta, Rim rim) {
  return ViewKernel(r, n, theta, 1, rim);
}

Kernel CellKernel(double r, int n, double theta) {
  constexpr double kNarrowest = 1e-6;
  if (n == 0) return IdealKernel(0, theta);
  return ViewKernel(r, n, theta, std::max(r / n, kNarrowest));
}

Kernel1 SampledAperture1(int n, double theta) {
  Kernel1 samples(n);
  for (int i = -n; i <= n; ++i) samples.at(i) = Aperture1(double(i) / n, theta);
  samples.Scale(1 / samples.Sum());
  return samples;
}

Kernel1 PaperKernel1(double r, int n, double theta) {
  Kernel1 kernel(RadiusOf(r, 1));
  const Kernel1 samples = SampledAperture1(n, theta);
  for (int i = -n; i <= n; ++i) {
    const double x = i * r / n;
    ForEachTap(x, 1, [&](int k) { kernel.at(k) += samples(i) * Trapezoid(k - x, 1); });
  }
  kernel.Scale(1 / kernel.Sum());
  return kernel;
}

}  // namespace starfocus::analysis
