// SPDX-License-Identifier: Apache-2.0
// What the engine's PSF should be, from its description: subapertures as line scans and slices
// render them.
#ifndef STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
#define STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_

#include "lib/analysis/sampled_psf.h"

namespace starfocus::analysis {

// How views stand for their subapertures: at most a pixel wide, the type B views
// (|i| = |j|) spread along their diagonal only; or as wide as r / N, all views along both axes.
enum class Subapertures { kNarrow, kWide };

// The PSF of N views at blur radius r, with positions and subapertures rounded to the engine's
// 1/256 pixel. A subaperture of up to 3 pixels covers what a box of its width does; a wider one, at
// most 7, is linear interpolation after a box on whole pixels. Wide subapertures lie as those of
// MakeSubapertures.
SampledPsf StarPsf(double r, int n, double theta, Subapertures subapertures);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
