// SPDX-License-Identifier: Apache-2.0
// Computes the errors of the subsampled layers, (10) to (12), with their half-band sinc filters
// with a Kaiser window, and the errors of openings without fall-off.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_

#include "examples/lab/analysis/ideal.h"

namespace starfocus::analysis {

inline constexpr int kHalfBandRadius = 3;  // seven taps

// Parameters of the paper's filters. The value of beta_U is chosen such that G_U(-1) = 0. The value
// of beta_D is that of Table I at r = 3.
inline constexpr double kBetaUp = 2.17;
inline constexpr double kBetaDown = 1.28;

// Returns sinc(n / 2) times the Kaiser window of `beta` >= 0, scaled to a sum of 1.
Taps HalfBand(double beta);

// Returns the gain at the highest frequency, G(e^{j omega}) at omega = pi, of a symmetric filter.
double GainAtPi(const Taps& psf);

// Returns the beta for which GainAtPi(HalfBand(beta)) = 0.
double BetaWithoutPi();

// Finds minima and sign changes of functions of one variable.

// Returns the position of the minimum of f in [low, high], by golden-section search to `tolerance`.
// The function f must have a single local minimum in [low, high].
template <class Function>
double Minimise(double low, double high, double tolerance, const Function& f) {
  constexpr double kGolden = 0.61803398874989485;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = f(a), at_b = f(b);
  while (high - low > tolerance) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = f(b);
    }
  }
  return (low + high) / 2;
}

// Returns the position of a sign change of f in [low, high], by bisection to `tolerance`.
template <class Function>
double Cross(double low, double high, double tolerance, const Function& f) {
  const bool positive = f(low) > 0;
  while (high - low > tolerance) {
    const double middle = (low + high) / 2;
    ((f(middle) > 0) == positive ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Analyses refocusing in the layer subsampled by two (III-D of the paper). Computes the equivalent
// PSF, its error (10) and its aliasing (11), and the filters that minimise the error (Table I).

// Selects the axes along which the PSF aliases. kNone selects the PSF B_{down 2} itself. kX, kY and
// kBoth select the PSFs E_i of (11), in which G_D(-z) replaces G_D(z) along x, along y or along
// both axes.
enum class Alias { kNone, kX, kY, kBoth };

// beta of the downsampling filter and theta of the aperture.
struct Filters {
  double beta_down;
  double theta;
};

// Returns G_U(z) B(z^2; r / 2) G_D(+-z), where B is the ideal PSF.
SampledPsf SubsampledPsf(double r, const Filters& filters, Alias alias);
Taps SubsampledPsf1(double r, const Filters& filters, bool alias);

// Returns the PSF at full size that results from a blur with PSF `half` in the subsampled layer:
// G_U(z) half(z^2) G_D(z).
SampledPsf ThroughLayer(const SampledPsf& half, double beta_down);

// Returns the aliasing of a blur with PSF `psf` in layer L = `layer`, in [0, 2]. The picture is
// downsampled L times before the blur and upsampled L times after the blur. The aliasing is the
// mean squared variation of the impulse response over the 4^L positions of the impulse. For L = 1
// and the ideal PSF, the aliasing is (11).
double LayerAliasing(const SampledPsf& psf, int layer, double beta_down);

// SubsampledError returns the SSE (10), and AliasingError the aliasing (11).
double SubsampledError(double r, const Filters& filters);
double AliasingError(double r, const Filters& filters);

// Filters with the smallest SSE (10) at r.
struct Optimum {
  double r;
  Filters filters;
  double error;     // SSE (10).
  double aliasing;  // Aliasing (11).
};
Optimum Optimise(double r);

// Returns the optimum with beta_D in steps of 0.01 and theta in steps of 0.01 pi. The paper does
// not state its step sizes. The result reproduces all printed digits of Table I; the unrestricted
// optimum of Optimise does not reproduce all digits.
Optimum OptimiseOnGrid(double r);

// Returns the r at which the error (10) with the best filters for r falls to `threshold`. The
// paper's rule (12) uses the next larger r of Table I.
double SmallestSubsampledRadius(double threshold);

// Analyses openings other than (3) in double precision. Computes the ideal PSF of an opening, the
// PSF of its subapertures, and the error of a layer. The engine's rules for N and layers of these
// openings are based on the results of this analysis (docs/constants.md, Openings).

// A part of the unit disc with uniform brightness.
struct BrightOpening {
  double inner = 0;  // radius of the round hole in the middle
  // Number of sides of a regular polygon with straight edges and a corner at (0, -1). If `blades`
  // is 0, the opening is a disc.
  int blades = 0;
  bool Contains(double u, double v) const;
};

// Returns the PSF (4) of the opening for r > 0.
SampledPsf IdealPsf(double r, const BrightOpening& opening);

// Returns the PSF of refocusing with subapertures, for N = n >= 1. Each view is spread over the
// width of its subaperture and weighted by the light that passes through the subaperture.
SampledPsf SubaperturePsf(double r, int n, const BrightOpening& opening);

// Returns the largest SSE (8) of SubaperturePsf over the radii from `r_min` to `r_max`, in steps of
// half a pixel.
double WorstOfSubapertures(int n, double r_min, double r_max, const BrightOpening& opening);

// Returns the SSE (10) of the opening's blur of radius r in layer 1, with the engine's filters.
double LayerError(double r, const BrightOpening& opening);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_
