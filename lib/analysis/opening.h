// SPDX-License-Identifier: Apache-2.0
// Openings other than (3), in double precision: their ideal PSFs, what subapertures make of
// them and what layers do. What says which N and layers they need (docs/constants.md, Openings).
#ifndef STARFOCUS_LIB_ANALYSIS_OPENING_H_
#define STARFOCUS_LIB_ANALYSIS_OPENING_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// A part of the unit disc that is as bright everywhere.
struct BrightOpening {
  double inner = 0;  // radius of its hole
  int blades = 0;    // of a regular polygon with straight edges and a corner at (0, -1); 0: a disc
  bool Contains(double u, double v) const;
};

// The PSF (4) of the opening for r > 0.
SampledPsf IdealPsf(double r, const BrightOpening& opening);

// The PSF of the views of ViewsBySubaperture's N >= 1, each as wide as its subaperture and with
// the part of the light that goes through it.
SampledPsf SubaperturePsf(double r, int n, const BrightOpening& opening);

// The largest SSE (8) of it over the radii from `r_min` to `r_max`, in steps of half a pixel.
double WorstOfSubapertures(int n, double r_min, double r_max, const BrightOpening& opening);

// The SSE (10) of the opening's blur by r in layer 1, with the filters that the engine has.
double LayerError(double r, const BrightOpening& opening);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_OPENING_H_
