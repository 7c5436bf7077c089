// SPDX-License-Identifier: Apache-2.0
// Analyses openings other than (3) in double precision. Computes the ideal PSF of an opening, the
// PSF of its subapertures, and the error of a layer. The engine's rules for N and layers of these
// openings are based on the results of this analysis (docs/constants.md, Openings).
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_OPENING_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_OPENING_H_

#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

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

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_OPENING_H_
