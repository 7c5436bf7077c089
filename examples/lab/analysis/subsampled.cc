// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/analysis/subsampled.h"

#include <algorithm>
#include <cmath>

#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/view_psf.h"
#include "lib/optics/view_weights.h"

namespace starfocus::analysis {
namespace {

// Returns the modified Bessel function of the first kind, order 0, by its power series.
double Bessel0(double x) {
  double sum = 1, term = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= (x / (2 * k)) * (x / (2 * k));
    sum += term;
  }
  return sum;
}

double Kaiser(int n, double beta) {
  const double place = double(n) / kHalfBandRadius;
  return Bessel0(beta * std::sqrt(1 - place * place)) / Bessel0(beta);
}

double HalfSinc(int n) { return n == 0 ? 1 : std::sin(kPi * n / 2) / (kPi * n / 2); }

}  // namespace

Taps HalfBand(double beta) {
  Taps psf(kHalfBandRadius);
  for (int n = -kHalfBandRadius; n <= kHalfBandRadius; ++n) {
    psf.at(n) = n != 0 && n % 2 == 0 ? 0 : HalfSinc(n) * Kaiser(n, beta);
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

double GainAtPi(const Taps& psf) {
  double gain = 0;
  for (int n = -psf.radius(); n <= psf.radius(); ++n) gain += n % 2 ? -psf(n) : psf(n);
  return gain;
}

double BetaWithoutPi() {
  return Cross(0, 4, 1e-12, [](double beta) { return GainAtPi(HalfBand(beta)); });
}

namespace {

constexpr double kHighestBeta = 8;
constexpr double kBetaStep = 0.01, kThetaStep = 0.01 * kPi;
constexpr double kLowestTheta = 0.05 * kPi, kHighestTheta = 0.45 * kPi;

// Returns G(-z) for a filter G(z): the signs of all odd taps are inverted.
Taps Alternated(Taps psf) {
  for (int n = -psf.radius(); n <= psf.radius(); ++n) {
    if (n % 2) psf.at(n) = -psf(n);
  }
  return psf;
}

Taps Convolve(const Taps& a, const Taps& b) {
  Taps result(a.radius() + b.radius());
  for (int n = -a.radius(); n <= a.radius(); ++n) {
    for (int k = -b.radius(); k <= b.radius(); ++k) result.at(n + k) += a(n) * b(k);
  }
  return result;
}

// Returns the PSF `half` upsampled with zeros, and then filtered with x along the first axis and
// with y along the second axis.
SampledPsf Spread(const SampledPsf& half, const Taps& x, const Taps& y) {
  const int inner = 2 * half.radius(), radius = inner + x.radius();
  SampledPsf rows(radius), result(radius);
  for (int n = -half.radius(); n <= half.radius(); ++n) {
    for (int m = -half.radius(); m <= half.radius(); ++m) {
      for (int k = -y.radius(); k <= y.radius(); ++k)
        rows.at(2 * n, 2 * m + k) += half(n, m) * y(k);
    }
  }
  for (int n = -inner; n <= inner; n += 2) {
    for (int m = -radius; m <= radius; ++m) {
      for (int k = -x.radius(); k <= x.radius(); ++k) result.at(n + k, m) += rows(n, m) * x(k);
    }
  }
  return result;
}

// Returns G_U(z) G_D(+-z) along one axis. The gain of 2 of G_U compensates for the zeros of
// upsampling.
Taps AxisFilter(double beta_down, bool alias) {
  const Taps down = HalfBand(beta_down);
  Taps up = HalfBand(kBetaUp);
  up.Scale(2);
  Taps filter = Convolve(up, alias ? Alternated(down) : down);
  // Downsampling followed by upsampling passes half the signal and half the alias.
  filter.Scale(0.5);
  return filter;
}

SampledPsf Subsampled(const SampledPsf& half, double beta_down, Alias alias) {
  return Spread(half, AxisFilter(beta_down, alias == Alias::kX || alias == Alias::kBoth),
                AxisFilter(beta_down, alias == Alias::kY || alias == Alias::kBoth));
}

// Returns the 1D impulse at position `place` after downsampling to the layer. Tap n of the result
// is pixel n of the layer.
Taps LayersDown(int place, int layer, double beta_down) {
  Taps line(0);
  line.at(0) = 1;
  int origin = place;  // position of line(0) in the pixels of its layer
  for (int k = 0; k < layer; ++k) {
    const Taps filtered = Convolve(line, HalfBand(beta_down));
    Taps kept(filtered.radius());  // larger than needed
    for (int n = -filtered.radius(); n <= filtered.radius(); ++n) {
      if ((n + origin) % 2 == 0) kept.at((n + origin) / 2) = filtered(n);
    }
    line = kept;
    origin = 0;
  }
  return line;
}

Taps LayersUp(int layer) {
  Taps filter(0);
  filter.at(0) = 1;
  Taps up = HalfBand(kBetaUp);
  up.Scale(2);
  for (int k = 0; k < layer; ++k) {
    Taps spread(2 * filter.radius());
    for (int n = -filter.radius(); n <= filter.radius(); ++n) spread.at(2 * n) = filter(n);
    filter = Convolve(spread, up);
  }
  return filter;
}

// Returns, for each k, the sum over n of f(n) f(n + k step), where f is `filter`. The sum is the
// correlation of the upsampled responses of two pixels of a layer that are k pixels apart.
Taps Correlation(const Taps& filter, int step) {
  Taps result(2 * filter.radius() / step);
  for (int k = -result.radius(); k <= result.radius(); ++k) {
    for (int n = -filter.radius(); n <= filter.radius(); ++n) {
      result.at(k) += filter(n) * filter(n + k * step);
    }
  }
  return result;
}

SampledPsf ConvolveAxes(const SampledPsf& psf, const Taps& x, const Taps& y) {
  const int inner = psf.radius(), more = std::max(x.radius(), y.radius());
  SampledPsf rows(inner + more), result(inner + more);
  for (int n = -inner; n <= inner; ++n) {
    for (int m = -inner; m <= inner; ++m) {
      for (int k = -y.radius(); k <= y.radius(); ++k) rows.at(n, m + k) += psf(n, m) * y(k);
    }
  }
  for (int n = -inner; n <= inner; ++n) {
    for (int m = -rows.radius(); m <= rows.radius(); ++m) {
      for (int k = -x.radius(); k <= x.radius(); ++k) result.at(n + k, m) += rows(n, m) * x(k);
    }
  }
  return result;
}

// Returns the smallest error (10) at theta, and sets *beta to the value that minimises the error.
double LeastError(double r, double theta, double* beta) {
  const SampledPsf ideal = IdealPsf(r, theta), half = IdealPsf(r / 2, theta);
  const auto error = [&](double b) {
    return SquaredError(Subsampled(half, b, Alias::kNone), ideal);
  };
  *beta = Minimise(0, kHighestBeta, 1e-4, error);
  return error(*beta);
}

Optimum MakeOptimum(double r, const Filters& filters) {
  return {r, filters, SubsampledError(r, filters), AliasingError(r, filters)};
}

}  // namespace

SampledPsf SubsampledPsf(double r, const Filters& filters, Alias alias) {
  return Subsampled(IdealPsf(r / 2, filters.theta), filters.beta_down, alias);
}

SampledPsf ThroughLayer(const SampledPsf& half, double beta_down) {
  return Subsampled(half, beta_down, Alias::kNone);
}

double LayerAliasing(const SampledPsf& psf, int layer, double beta_down) {
  const int places = 1 << layer;
  const Taps common = Correlation(LayersUp(layer), places);
  double mean = 0;  // mean of the squared impulse responses
  for (int a = 0; a < places; ++a) {
    for (int b = 0; b < places; ++b) {
      const SampledPsf blurred =
          ConvolveAxes(psf, LayersDown(a, layer, beta_down), LayersDown(b, layer, beta_down));
      const SampledPsf seen = ConvolveAxes(blurred, common, common);
      for (int n = -blurred.radius(); n <= blurred.radius(); ++n) {
        for (int m = -blurred.radius(); m <= blurred.radius(); ++m) {
          mean += blurred(n, m) * seen(n, m) / (places * places);
        }
      }
    }
  }
  SampledPsf through = psf;
  for (int k = 0; k < layer; ++k) through = ThroughLayer(through, beta_down);
  return mean - Energy(through);
}

Taps SubsampledPsf1(double r, const Filters& filters, bool alias) {
  const Taps half = IdealPsf1(r / 2, filters.theta);
  Taps spread(2 * half.radius());
  for (int n = -half.radius(); n <= half.radius(); ++n) spread.at(2 * n) = half(n);
  return Convolve(spread, AxisFilter(filters.beta_down, alias));
}

double SubsampledError(double r, const Filters& filters) {
  return SquaredError(SubsampledPsf(r, filters, Alias::kNone), IdealPsf(r, filters.theta));
}

double AliasingError(double r, const Filters& filters) {
  double sum = 0;
  for (const Alias alias : {Alias::kX, Alias::kY, Alias::kBoth}) {
    sum += Energy(SubsampledPsf(r, filters, alias));
  }
  return sum;
}

Optimum Optimise(double r) {
  double beta = 0;
  const double theta = Minimise(kLowestTheta, kHighestTheta, 1e-5,
                                [&](double t) { return LeastError(r, t, &beta); });
  Filters filters = {0, theta};
  LeastError(r, theta, &filters.beta_down);
  return MakeOptimum(r, filters);
}

Optimum OptimiseOnGrid(double r) {
  Filters best = {0, 0};
  double least = 1;  // larger than the error of any PSF with a sum of 1
  const int first = static_cast<int>(std::round(kLowestTheta / kThetaStep));
  const int last = static_cast<int>(std::round(kHighestTheta / kThetaStep));
  for (int k = first; k <= last; ++k) {
    const double theta = k * kThetaStep;
    double beta = 0;
    LeastError(r, theta, &beta);
    // The error has a single minimum in beta, so the best multiple of kBetaStep is adjacent to the
    // minimum.
    for (const double step : {std::floor(beta / kBetaStep), std::ceil(beta / kBetaStep)}) {
      const Filters filters = {step * kBetaStep, theta};
      const double error = SubsampledError(r, filters);
      if (error < least) least = error, best = filters;
    }
  }
  return MakeOptimum(r, best);
}

double SmallestSubsampledRadius(double threshold) {
  return Cross(2, 4, 1e-3, [&](double r) { return Optimise(r).error - threshold; });
}

namespace {

// Returns the share of a square that is open. The square has sides of `side` and is centred at (u,
// v). The function counts the open points of a grid, unless the whole square is clearly open or
// closed.
double Share(const BrightOpening& opening, double u, double v, double side) {
  constexpr int kPoints = 64;
  int corners = 0;
  for (const double du : {-0.5, 0.5}) {
    for (const double dv : {-0.5, 0.5}) corners += opening.Contains(u + du * side, v + dv * side);
  }
  const double reach = side / std::sqrt(2.0), middle = std::hypot(u, v);
  if (opening.inner == 0 && corners == 4) return 1;
  if (middle - reach > 1) return 0;
  int inside = 0;
  for (int point = 0; point < kPoints * kPoints; ++point) {
    const double du = (point % kPoints + 0.5) / kPoints - 0.5;
    const double dv = (point / kPoints + 0.5) / kPoints - 0.5;
    inside += opening.Contains(u + du * side, v + dv * side) ? 1 : 0;
  }
  return double(inside) / (kPoints * kPoints);
}

}  // namespace

bool BrightOpening::Contains(double u, double v) const {
  const double square = u * u + v * v;
  if (square > 1 || square < inner * inner) return false;
  for (int k = 0; k < blades; ++k) {
    const double angle = (2 * k + 1) * kPi / blades;
    if (u * std::sin(angle) - v * std::cos(angle) > std::cos(kPi / blades)) return false;
  }
  return true;
}

SampledPsf IdealPsf(double r, const BrightOpening& opening) {
  SampledPsf psf(static_cast<int>(std::ceil(r + 0.5)));
  for (int n = -psf.radius(); n <= psf.radius(); ++n) {
    for (int m = -psf.radius(); m <= psf.radius(); ++m) {
      psf.at(n, m) = Share(opening, n / r, m / r, 1 / r);
    }
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

SampledPsf SubaperturePsf(double r, int n, const BrightOpening& opening) {
  const double lens = double(LensInSubapertures(n)) / kSubapertureUnits;
  const int last = LastSubaperture(n), most = MostOfSubapertures(n);
  const double width = r / lens;  // width of a subaperture in pixels
  SampledPsf psf(static_cast<int>(std::ceil(last * width + (width + 1) / 2)));
  for (int i = -last; i <= last; ++i) {
    for (int j = -last; j <= last; ++j) {
      if (i * i + j * j > most) continue;
      const double light = Share(opening, i / lens, j / lens, 1 / lens);
      const double x = i * width, y = j * width, reach = (width + 1) / 2;
      for (int k = int(std::ceil(x - reach)); k <= int(std::floor(x + reach)); ++k) {
        for (int m = int(std::ceil(y - reach)); m <= int(std::floor(y + reach)); ++m) {
          psf.at(k, m) += light * Trapezoid(k - x, width) * Trapezoid(m - y, width);
        }
      }
    }
  }
  psf.Scale(1 / psf.Sum());
  return psf;
}

double WorstOfSubapertures(int n, double r_min, double r_max, const BrightOpening& opening) {
  double worst = 0;
  for (double r = r_min; r <= r_max; r += 0.5) {
    worst = std::max(worst, SquaredError(SubaperturePsf(r, n, opening), IdealPsf(r, opening)));
  }
  return worst;
}

double LayerError(double r, const BrightOpening& opening) {
  return SquaredError(ThroughLayer(IdealPsf(r / 2, opening), kBetaDown), IdealPsf(r, opening));
}

}  // namespace starfocus::analysis
