// SPDX-License-Identifier: Apache-2.0
// Computes the PSF that the engine is designed to have. Subapertures are modelled as the
// line scan and the slice renderer render them.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_STAR_PSF_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_STAR_PSF_H_

#include "examples/lab/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Shapes of subapertures. With narrow subapertures, each view is spread over at most one pixel.
// Views of type B (|i| = |j|; IV-B of the paper) are spread along the diagonal only. With wide
// subapertures, each view is spread over r / N pixels along both axes.
enum class Subapertures { kNarrow, kWide };

// Returns the PSF of N views at blur radius r, with positions and subapertures rounded to the
// engine's 1/256 pixel. A subaperture that is up to 3 pixels wide is a box. A wider subaperture, of
// at most 7 pixels, is a box on whole pixels followed by linear interpolation. If `subapertures` is
// kWide, views have the positions that MakeSubapertures computes, and subapertures narrower than a
// pixel move pixels like the inside of a slice (lib/slices/slice_plane.cc).
SampledPsf StarPsf(double r, int n, double theta, Subapertures subapertures);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_STAR_PSF_H_
