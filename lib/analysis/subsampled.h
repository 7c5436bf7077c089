// SPDX-License-Identifier: Apache-2.0
// Refocusing in the subsampled-by-two layer (paper, III-D): the equivalent blur, its error (10),
// its aliasing (11), and the filters that minimise the error (Table I).
#ifndef STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_
#define STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Selects the axes that alias. kNone is B_{down 2} itself. The others are the PSFs E_i, in which
// G_D(z) is replaced by G_D(-z) along x, along y or along both axes.
enum class Alias { kNone, kX, kY, kBoth };

// beta of the downsampling filter and theta of the aperture.
struct Filters {
  double beta_down;
  double theta;
};

// Returns G_U(z) B(z^2; r / 2) G_D(+-z), where B is the ideal PSF.
SampledPsf SubsampledPsf(double r, const Filters& filters, Alias alias);
Taps SubsampledPsf1(double r, const Filters& filters, bool alias);

// Returns the effect on the picture of a blur `half` in the layer below: G_U(z) half(z^2) G_D(z).
SampledPsf ThroughLayer(const SampledPsf& half, double beta_down);

// Returns the aliasing of a blur `psf` of layer L in [0, 2], with L layers down and up again. It is
// the mean squared variation of the impulse response over the 4^L positions of the impulse. For L =
// 1 and the ideal PSF it is (11).
double LayerAliasing(const SampledPsf& psf, int layer, double beta_down);

// Return the SSE of (10) and (11).
double SubsampledError(double r, const Filters& filters);
double AliasingError(double r, const Filters& filters);

// Filters with the smallest SSE (10) at r.
struct Optimum {
  double r;
  Filters filters;
  double error;     // (10)
  double aliasing;  // (11)
};
Optimum Optimise(double r);

// Returns the optimum with beta_D in steps of 0.01 and theta in steps of 0.01 pi. The paper does
// not state its steps. These give all printed digits of Table I, which the free optimum does not.
Optimum OptimiseOnGrid(double r);

// Returns the r at which (10), with the best filters for it, falls to `threshold`. (12) uses the
// next row of Table I.
double SmallestSubsampledRadius(double threshold);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_
