// SPDX-License-Identifier: Apache-2.0
// Openings other than (3), in double precision: their ideal PSFs, the PSFs of their subapertures,
// and the errors of layers. The values of N and the layers that openings need follow from these
// (docs/constants.md, Openings).
#ifndef STARFOCUS_LIB_ANALYSIS_OPENING_H_
#define STARFOCUS_LIB_ANALYSIS_OPENING_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// A part of the unit disc with uniform brightness.
struct BrightOpening {
  double inner = 0;  // radius of its hole
  // Number of sides of a regular polygon with straight edges and a corner at (0, -1). 0: a disc.
  int blades = 0;
  bool Contains(double u, double v) const;
};

// Returns the PSF (4) of the opening for r > 0.
SampledPsf IdealPsf(double r, const BrightOpening& opening);

// Returns the PSF of the views of ViewsBySubaperture's N >= 1. Each view is as wide as its
// subaperture and has the light that passes through it.
SampledPsf SubaperturePsf(double r, int n, const BrightOpening& opening);

// Returns the largest SSE (8) of SubaperturePsf over the radii from `r_min` to `r_max`, in steps of
// half a pixel.
double WorstOfSubapertures(int n, double r_min, double r_max, const BrightOpening& opening);

// Returns the SSE (10) of the opening's blur of radius r in layer 1, with the engine's filters.
double LayerError(double r, const BrightOpening& opening);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_OPENING_H_
