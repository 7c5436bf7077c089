#include "lib/analysis/star_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/analysis/aperture.h"
#include "lib/analysis/ideal.h"
#include "lib/analysis/view_kernel.h"
#include "lib/fixed.h"

namespace starfocus::analysis {
namespace {

constexpr double kNarrowest = 1e-6;

// Calls visit(p, share) for the pixels that a sample at `x` reaches.
template <class Visit>
void Spread(double x, double width, const Visit& visit) {
  const int first = static_cast<int>(std::floor(x));
  for (int p = first; p <= first + 1; ++p) visit(p, Trapezoid(p - x, width));
}

}  // namespace

Kernel StarKernel(double r, int n, double theta) {
  if (n == 0) return IdealKernel(0, theta);
  const double width = std::clamp(r / n, kNarrowest, 1.0);
  Kernel kernel(static_cast<int>(std::ceil(r)) + 1);
  const auto place = [&](int i) { return std::round(i * r / n * kShiftOne) / kShiftOne; };
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      if (i * i + j * j > n * n) continue;
      const double weight = Aperture(double(i * i + j * j) / (double(n) * n), theta);
      const bool diagonal = i != 0 && std::abs(i) == std::abs(j);
      Spread(place(i), width, [&](int x, double share) {
        if (diagonal) {
          kernel.at(x, i == j ? x : -x) += weight * share;
          return;
        }
        Spread(place(j), width,
               [&](int y, double part) { kernel.at(x, y) += weight * share * part; });
      });
    }
  }
  kernel.Scale(1 / kernel.Sum());
  return kernel;
}

}  // namespace starfocus::analysis
