// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/star_psf.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/base/fixed.h"
#include "lib/optics/view_weights.h"
#include "lib/slices/slice_plane.h"

namespace starfocus::analysis {
namespace {

constexpr double kNarrowest = 1e-6, kWidest = 7;

// Footprint of a view along one axis. The footprint is a single tap or, for subapertures wider than
// kBoxSubaperture, the taps of a box on whole pixels. Each tap is then spread by a box of `width`;
// a box of up to one pixel is the interpolation.
struct Footprint {
  double width;
  Taps taps;
};

Footprint MakeFootprint(double subaperture, Subapertures subapertures) {
  const double width = std::min(kWidest, std::round(kShiftOne * subaperture) / kShiftOne);
  if (subapertures == Subapertures::kNarrow || width <= 1) {
    Footprint narrow = {std::clamp(subaperture, kNarrowest, 1.0), Taps(0)};
    narrow.taps.at(0) = 1;
    return narrow;
  }
  if (width * kShiftOne <= kBoxSubaperture) {
    Footprint box = {width, Taps(static_cast<int>(std::ceil((width - 1) / 2)))};
    box.taps.at(0) = 1;
    return box;
  }
  Footprint wide = {1, Taps(static_cast<int>(std::ceil((width - 1) / 2)))};
  for (int n = -wide.taps.radius(); n <= wide.taps.radius(); ++n) {
    wide.taps.at(n) = Trapezoid(n, width);
  }
  return wide;
}

// Calls visit(p, share) for each pixel p over which a sample at `x` is spread.
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

SampledPsf StarPsf(double radius, int n, double theta, Subapertures subapertures) {
  if (n == 0) return IdealPsf(0, theta);
  const bool narrow = subapertures == Subapertures::kNarrow;
  const SubapertureLights lights(narrow ? 0 : n, theta);
  const int last = narrow ? n : LastSubaperture(n), most = narrow ? n * n : MostOfSubapertures(n);
  const double step = narrow ? radius / n : radius * kSubapertureUnits / LensInSubapertures(n);
  const Footprint footprint = MakeFootprint(step, subapertures);
  SampledPsf psf(static_cast<int>(std::ceil(last * step)) + 1 + footprint.taps.radius());
  const auto place = [&](int i) { return std::round(i * step * kShiftOne) / kShiftOne; };
  for (int i = -last; i <= last; ++i) {
    Taps column(psf.radius());
    for (int j = -last; j <= last; ++j) {
      if (i * i + j * j > most) continue;
      const double weight =
          narrow ? Aperture(double(i * i + j * j) / (double(n) * n), theta) : lights(i, j);
      if (subapertures == Subapertures::kNarrow && i != 0 && std::abs(i) == std::abs(j)) {
        Spread(place(i), footprint,
               [&](int x, double share) { psf.at(x, i == j ? x : -x) += weight * share; });
      } else {
        Spread(place(j), footprint, [&](int y, double share) { column.at(y) += weight * share; });
      }
    }
    Spread(place(i), footprint, [&](int x, double share) {
      for (int y = -psf.radius(); y <= psf.radius(); ++y) {
        psf.at(x, y) += share * column(y);
      }
    });
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

}  // namespace starfocus::analysis
