// SPDX-License-Identifier: Apache-2.0
#include "lib/analysis/star_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lib/analysis/aperture.h"
#include "lib/analysis/ideal.h"
#include "lib/analysis/view_kernel.h"
#include "lib/base/fixed.h"
#include "lib/base/view_weights.h"
#include "lib/slices/slice_plane.h"

namespace starfocus::analysis {
namespace {

constexpr double kNarrowest = 1e-6, kWidest = 7;

// A view's footprint on the line: one tap, or those of a box on whole pixels for subapertures wider
// than kBoxSubaperture, each then spread by a box of `width`; up to a pixel that is the
// interpolation.
struct Footprint {
  double width;
  Kernel1 taps;
};

Footprint MakeFootprint(double subaperture, Subapertures subapertures) {
  const double width = std::min(kWidest, std::round(kShiftOne * subaperture) / kShiftOne);
  if (subapertures == Subapertures::kNarrow || width <= 1) {
    Footprint narrow = {std::clamp(subaperture, kNarrowest, 1.0), Kernel1(0)};
    narrow.taps.at(0) = 1;
    return narrow;
  }
  if (width * kShiftOne <= kBoxSubaperture) {
    Footprint box = {width, Kernel1(static_cast<int>(std::ceil((width - 1) / 2)))};
    box.taps.at(0) = 1;
    return box;
  }
  Footprint wide = {1, Kernel1(static_cast<int>(std::ceil((width - 1) / 2)))};
  for (int n = -wide.taps.radius(); n <= wide.taps.radius(); ++n) {
    wide.taps.at(n) = Trapezoid(n, width);
  }
  return wide;
}

// Calls visit(p, share) for the pixels that a sample at `x` reaches.
template <class Visit>
void Spread(double x, const Footprint& footprint, const Visit& visit) {
  const int first = static_cast<int>(std::floor(x)), reach = footprint.taps.radius();
  for (int p = first - reach; p <= first + 1 + reach; ++p) {
    double share = 0;
    for (int k = -reach; k <= reach; ++k) {
      share += footprint.taps(k) * Trapezoid(p - k - x, footprint.width);
    }
    visit(p, share);
  }
}

}  // namespace

Kernel StarKernel(double radius, int n, double theta, Subapertures subapertures) {
  if (n == 0) return IdealKernel(0, theta);
  const bool narrow = subapertures == Subapertures::kNarrow;
  const SubapertureLights lights(narrow ? 0 : n, theta);
  const int last = narrow ? n : LastSubaperture(n), most = narrow ? n * n : MostOfSubapertures(n);
  const double step = narrow ? radius / n : radius * kSubapertureUnits / LensInSubapertures(n);
  const Footprint footprint = MakeFootprint(step, subapertures);
  Kernel kernel(static_cast<int>(std::ceil(last * step)) + 1 + footprint.taps.radius());
  const auto place = [&](int i) { return std::round(i * step * kShiftOne) / kShiftOne; };
  for (int i = -last; i <= last; ++i) {
    Kernel1 column(kernel.radius());
    for (int j = -last; j <= last; ++j) {
      if (i * i + j * j > most) continue;
      const double weight =
          narrow ? Aperture(double(i * i + j * j) / (double(n) * n), theta) : lights(i, j);
      if (subapertures == Subapertures::kNarrow && i != 0 && std::abs(i) == std::abs(j)) {
        Spread(place(i), footprint,
               [&](int x, double share) { kernel.at(x, i == j ? x : -x) += weight * share; });
      } else {
        Spread(place(j), footprint, [&](int y, double share) { column.at(y) += weight * share; });
      }
    }
    Spread(place(i), footprint, [&](int x, double share) {
      for (int y = -kernel.radius(); y <= kernel.radius(); ++y) {
        kernel.at(x, y) += share * column(y);
      }
    });
  }
  kernel.Scale(1 / kernel.Sum());
  return kernel;
}

}  // namespace starfocus::analysis
