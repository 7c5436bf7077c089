#include "lib/analysis/subsampled.h"

#include <cmath>

#include "lib/analysis/aperture.h"
#include "lib/analysis/half_band.h"
#include "lib/analysis/ideal.h"
#include "lib/analysis/search.h"

namespace starfocus::analysis {
namespace {

constexpr double kHighestBeta = 8;
constexpr double kBetaStep = 0.01, kThetaStep = 0.01 * kPi;
constexpr double kLowestTheta = 0.05 * kPi, kHighestTheta = 0.45 * kPi;

// a[n] with the sign of odd taps turned: G(-z).
Kernel1 Alternated(Kernel1 kernel) {
  for (int n = -kernel.radius(); n <= kernel.radius(); ++n) {
    if (n % 2) kernel.at(n) = -kernel(n);
  }
  return kernel;
}

Kernel1 Convolve(const Kernel1& a, const Kernel1& b) {
  Kernel1 result(a.radius() + b.radius());
  for (int n = -a.radius(); n <= a.radius(); ++n) {
    for (int k = -b.radius(); k <= b.radius(); ++k) result.at(n + k) += a(n) * b(k);
  }
  return result;
}

// b[n, m] upsampled by zeros, then filtered with x along the first axis and y along the second.
Kernel Spread(const Kernel& half, const Kernel1& x, const Kernel1& y) {
  const int inner = 2 * half.radius(), radius = inner + x.radius();
  Kernel rows(radius), result(radius);
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

// G_U(z) G_D(+-z) along one axis. G_U's gain of 2 makes up for the zeros of upsampling.
Kernel1 AxisFilter(double beta_down, bool alias) {
  const Kernel1 down = HalfBand(beta_down);
  Kernel1 up = HalfBand(kBetaUp);
  up.Scale(2);
  Kernel1 filter = Convolve(up, alias ? Alternated(down) : down);
  filter.Scale(0.5);  // downsampling and upsampling pass half signal, half alias
  return filter;
}

Kernel Subsampled(const Kernel& half, double beta_down, Alias alias) {
  return Spread(half, AxisFilter(beta_down, alias == Alias::kX || alias == Alias::kBoth),
                AxisFilter(beta_down, alias == Alias::kY || alias == Alias::kBoth));
}

// The error (10) at theta and the beta that makes it least.
double LeastError(double r, double theta, double* beta) {
  const Kernel ideal = IdealKernel(r, theta), half = IdealKernel(r / 2, theta);
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

Kernel SubsampledKernel(double r, const Filters& filters, Alias alias) {
  return Subsampled(IdealKernel(r / 2, filters.theta), filters.beta_down, alias);
}

Kernel1 SubsampledKernel1(double r, const Filters& filters, bool alias) {
  const Kernel1 half = IdealKernel1(r / 2, filters.theta);
  Kernel1 spread(2 * half.radius());
  for (int n = -half.radius(); n <= half.radius(); ++n) spread.at(2 * n) = half(n);
  return Convolve(spread, AxisFilter(filters.beta_down, alias));
}

double SubsampledError(double r, const Filters& filters) {
  return SquaredError(SubsampledKernel(r, filters, Alias::kNone), IdealKernel(r, filters.theta));
}

double AliasingError(double r, const Filters& filters) {
  double sum = 0;
  for (const Alias alias : {Alias::kX, Alias::kY, Alias::kBoth}) {
    sum += Energy(SubsampledKernel(r, filters, alias));
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
  double least = 1;  // more than any kernel of unit sum is wrong by
  const int first = static_cast<int>(std::round(kLowestTheta / kThetaStep));
  const int last = static_cast<int>(std::round(kHighestTheta / kThetaStep));
  for (int k = first; k <= last; ++k) {
    const double theta = k * kThetaStep;
    double beta = 0;
    LeastError(r, theta, &beta);
    // The error has one minimum in beta, so that the best step lies beside it.
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

}  // namespace starfocus::analysis
