// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/analysis/view_psf.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "examples/lab/analysis/ideal.h"
#include "lib/base/fixed.h"
#include "lib/optics/view_weights.h"
#include "lib/slices/slice_plane.h"

namespace starfocus::analysis {
namespace {

// Calls visit(n) for every pixel n that overlaps a footprint of `width` centred at `x`.
template <class Visit>
void ForEachTap(double x, double width, const Visit& visit) {
  const double reach = (width + 1) / 2;
  const int last = static_cast<int>(std::floor(x + reach));
  for (int n = static_cast<int>(std::ceil(x - reach)); n <= last; ++n) visit(n);
}

int RadiusOf(double r, double width) { return static_cast<int>(std::ceil(r + (width + 1) / 2)); }

// Returns the weighted sum of the PSFs of all views (i, j) with |i| <= last and i^2 + j^2 <= most.
// Adjacent views are `step` pixels apart.
template <class Weight>
SampledPsf SumViews(int last, int most, double step, double width, const Weight& weight) {
  SampledPsf psf(RadiusOf(last * step, width));
  for (int i = -last; i <= last; ++i) {
    Taps column(psf.radius());
    for (int j = -last; j <= last; ++j) {
      if (i * i + j * j > most) continue;
      const double y = j * step, light = weight(i, j);
      ForEachTap(y, width, [&](int m) { column.at(m) += light * Trapezoid(m - y, width); });
    }
    const double x = i * step;
    ForEachTap(x, width, [&](int k) {
      const double share = Trapezoid(k - x, width);
      for (int m = -psf.radius(); m <= psf.radius(); ++m) psf.at(k, m) += share * column(m);
    });
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

}  // namespace

double Trapezoid(double t, double width) {
  const double overlap = (1 + width) / 2 - std::fabs(t);
  return std::clamp(overlap, 0.0, std::min(width, 1.0)) / width;
}

SampledPsf ViewPsf(double r, int n, double theta, double width, Rim rim) {
  return SumViews(n, n * n - (rim == Rim::kExcluded ? 1 : 0), r / n, width, [&](int i, int j) {
    return Aperture(double(i * i + j * j) / (double(n) * n), theta);
  });
}

SampledPsf PaperPsf(double r, int n, double theta, Rim rim) { return ViewPsf(r, n, theta, 1, rim); }

SubapertureLights::SubapertureLights(int n, double theta)
    : SubapertureLights(theta, LensInSubapertures(n)) {}

SubapertureLights::SubapertureLights(double theta, int units) : lens_(units) {
  constexpr int kPoints = 16;
  const double lens = double(units) / kSubapertureUnits;
  for (int i = 0; i <= LastOfLens(units); ++i) {
    for (int j = 0; j <= i; ++j) {
      double light = 0;
      for (int point = 0; point < kPoints * kPoints; ++point) {
        const double x = i + (point % kPoints + 0.5) / kPoints - 0.5;
        const double y = j + (point / kPoints + 0.5) / kPoints - 0.5;
        light += Aperture((x * x + y * y) / (lens * lens), theta);
      }
      lights_.push_back(light);
    }
  }
}

int SubapertureLights::views() const {
  const int last = LastOfLens(lens_), most = MostOfLens(lens_);
  int count = 0;
  for (int i = -last; i <= last; ++i) {
    for (int j = -last; j <= last; ++j) count += i * i + j * j <= most ? 1 : 0;
  }
  return count;
}

double SubapertureLights::operator()(int i, int j) const {
  const int high = std::max(std::abs(i), std::abs(j)), low = std::min(std::abs(i), std::abs(j));
  return lights_[size_t(high * (high + 1) / 2 + low)];
}

SampledPsf SubaperturePsf(double r, const SubapertureLights& lights) {
  constexpr double kNarrowest = 1e-6;
  const double subaperture = r * kSubapertureUnits / lights.lens();
  return SumViews(LastOfLens(lights.lens()), MostOfLens(lights.lens()), subaperture,
                  std::max(subaperture, kNarrowest), lights);
}

SampledPsf SubaperturePsf(double r, int n, double theta) {
  return n == 0 ? IdealPsf(0, theta) : SubaperturePsf(r, SubapertureLights(n, theta));
}

Taps SampledAperture1(int n, double theta) {
  Taps samples(n);
  for (int i = -n; i <= n; ++i) samples.at(i) = Aperture1(double(i) / n, theta);
  samples.Scale(1 / samples.Sum());
  return samples;
}

Taps PaperPsf1(double r, int n, double theta) {
  Taps psf(RadiusOf(r, 1));
  const Taps samples = SampledAperture1(n, theta);
  for (int i = -n; i <= n; ++i) {
    const double x = i * r / n;
    ForEachTap(x, 1, [&](int k) { psf.at(k) += samples(i) * Trapezoid(k - x, 1); });
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

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

// Returns the factor by which the slice renderer moves pixels inside a slice more or less than the
// views, if subapertures are narrower than a pixel. weights[i] is the light of the views at a
// distance of i steps along an axis. The factor makes the variance of the PSF exceed the variance
// of the views by a quarter, or by 1/24 of a pixel.
double InnerScale(double step, const std::vector<double>& weights) {
  const double outermost = step * static_cast<double>(weights.size() - 1);
  double total = 0, exact = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    const double x = step * static_cast<double>(i);
    total += weights[i];
    exact += weights[i] * (x * x + step * step / 12);
  }
  const double wanted = exact / total + std::min(exact / total / 4, 1.0 / 24);
  const auto is_narrow = [&](double scale) {
    const Footprint footprint = MakeFootprint(scale * step, Subapertures::kNarrow);
    double sum = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
      Spread(scale * step * static_cast<double>(i), footprint,
             [&](int x, double share) { sum += weights[i] * share * x * x; });
    }
    return sum < wanted * total;
  };
  double low = 0, high = std::max(outermost, 1.0) / outermost;
  if (is_narrow(high)) return high;
  for (int k = 0; k < 12; ++k) {
    const double middle = (low + high) / 2;
    (is_narrow(middle) ? low : high) = middle;
  }
  return high;
}

}  // namespace

SampledPsf StarPsf(double radius, int n, double theta, Subapertures subapertures) {
  if (n == 0) return IdealPsf(0, theta);
  const bool narrow = subapertures == Subapertures::kNarrow;
  const SubapertureLights lights(narrow ? 0 : n, theta);
  const int last = narrow ? n : LastSubaperture(n), most = narrow ? n * n : MostOfSubapertures(n);
  const double step = narrow ? radius / n : radius * kSubapertureUnits / LensInSubapertures(n);
  double scale = 1;
  if (!narrow && step > 0 && step < 1) {
    std::vector<double> weights(static_cast<size_t>(last) + 1);
    for (int i = -last; i <= last; ++i) {
      for (int j = -last; j <= last; ++j) {
        if (i * i + j * j <= most) weights[static_cast<size_t>(std::abs(i))] += lights(i, j);
      }
    }
    scale = InnerScale(step, weights);
  }
  const Footprint footprint = MakeFootprint(scale * step, subapertures);
  SampledPsf psf(static_cast<int>(std::ceil(last * step)) + 1 + footprint.taps.radius());
  const auto place = [&](int i) { return scale * std::round(i * step * kShiftOne) / kShiftOne; };
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
