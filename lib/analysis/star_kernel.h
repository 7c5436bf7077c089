// What the engine's kernel should be, from its description: aperture cells as the star renders
// them.
#ifndef STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
#define STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_

#include "lib/analysis/kernel.h"

namespace starfocus::analysis {

// How views stand for their cells of the aperture: at most a pixel wide, the type B views
// (|i| = |j|) spread along their diagonal only; or as wide as r / N, all views along both axes.
enum class Cells { kNarrow, kWide };

// The kernel of N views at blur radius r, positions rounded to the engine's 1/256 pixel. A wide
// cell is r / N to 1/8 pixel, at most 7: linear interpolation after a mixture of the two odd boxes
// around its width, of the cell's variance.
Kernel StarKernel(double r, int n, double theta, Cells cells);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_STAR_KERNEL_H_
