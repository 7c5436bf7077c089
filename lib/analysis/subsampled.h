// SPDX-License-Identifier: Apache-2.0
// Refocusing in the subsampled-by-two layer (paper, III-D): the equivalent blur, its error (10),
// its aliasing (11) and the filters that minimise the error (Table I).
#ifndef STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_
#define STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Which axes alias: B_{down 2} itself, or one of the PSFs E_i, whose G_D(z) is G_D(-z) along x,
// along y or along both.
enum class Alias { kNone, kX, kY, kBoth };

// The downsampling filter's beta and the aperture's theta.
struct Filters {
  double beta_down;
  double theta;
};

// G_U(z) B(z^2; r / 2) G_D(+-z), B being the ideal PSF.
SampledPsf SubsampledPsf(double r, const Filters& filters, Alias alias);
Taps SubsampledPsf1(double r, const Filters& filters, bool alias);

// What the picture sees of a blur `half` of the layer below: G_U(z) half(z^2) G_D(z).
SampledPsf ThroughLayer(const SampledPsf& half, double beta_down);

// The aliasing of a blur `PSF` of layer L in [0, 2] when L layers lead down to it and up again:
// how far the response to an impulse varies with its place, in mean square over the 4^L places.
// (11) for L = 1 and the ideal PSF.
double LayerAliasing(const SampledPsf& psf, int layer, double beta_down);

// SSE of (10) and (11).
double SubsampledError(double r, const Filters& filters);
double AliasingError(double r, const Filters& filters);

// The filters of least SSE (10) at r.
struct Optimum {
  double r;
  Filters filters;
  double error;     // (10)
  double aliasing;  // (11)
};
Optimum Optimise(double r);

// Returns the optimum with beta_D in steps of 0.01 and theta in steps of 0.01 pi. The paper does
// not state its steps; these give all printed digits of Table I, which the free optimum does not.
Optimum OptimiseOnGrid(double r);

// The r at which (10), with the filters that are best there, falls to `threshold`; (12) takes the
// next row of Table I.
double SmallestSubsampledRadius(double threshold);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_SUBSAMPLED_H_
