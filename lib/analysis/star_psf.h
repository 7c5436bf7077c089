// SPDX-License-Identifier: Apache-2.0
// The PSF that the engine should have according to its description: subapertures as line scans and
// slices render them.
#ifndef STARFOCUS_LIB_ANALYSIS_STAR_PSF_H_
#define STARFOCUS_LIB_ANALYSIS_STAR_PSF_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// Shapes of subapertures. Narrow ones are at most a pixel wide, and type B views (|i| = |j|) are
// spread along their diagonal only. Wide ones are as wide as r / N, and all views are spread along
// both axes.
enum class Subapertures { kNarrow, kWide };

// Returns the PSF of N views at blur radius r, with positions and subapertures rounded to the
// engine's 1/256 pixel. A subaperture of up to 3 pixels is a box of its width. A wider one, of at
// most 7 pixels, is a box on whole pixels followed by linear interpolation. Wide subapertures have
// the positions of MakeSubapertures.
SampledPsf StarPsf(double r, int n, double theta, Subapertures subapertures);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_STAR_PSF_H_
