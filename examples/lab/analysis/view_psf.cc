// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/view_psf.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/ideal.h"
#include "lib/optics/view_weights.h"

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

}  // namespace starfocus::analysis
