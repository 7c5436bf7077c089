// SPDX-License-Identifier: Apache-2.0
// Analyses refocusing in the layer subsampled by two (III-D of the paper). Computes the equivalent
// PSF, its error (10) and its aliasing (11), and the filters that minimise the error (Table I).
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_

#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

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

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_SUBSAMPLED_H_
