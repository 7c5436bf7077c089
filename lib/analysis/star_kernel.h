// What the engine's kernel should be, from its description: aperture cells as the star renders
// them.
#ifndef STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
#define STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_

#include "lib/analysis/kernel.h"

namespace starfocus::analysis {

// Aperture cells of width min(r / N, 1), type A and C views spread along both axes, type B views
// (|i| = |j|) along their diagonal only; positions rounded to the engine's 1/256 pixel.
Kernel StarKernel(double r, int n, double theta);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
