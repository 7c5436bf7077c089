// The kernel of the running engine: its answer to one white pixel on a flat black surface.
#ifndef STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_
#define STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_

#include "lib/analysis/kernel.h"
#include "starfocus/starfocus.h"

namespace starfocus::analysis {

// What to measure: frame-based refocusing through sf_refocus with u_t = 1.
struct EngineProbe {
  double r;      // d - d_t of the surface in pixels, |r| <= 60; the sign tells the direction
  double r_max;  // largest blur radius of the disparity range, >= |r|: the engine takes N from it
};

struct EngineKernel {
  Kernel kernel;  // unit white: taps sum to 1
  int n;          // N the engine chose
};

// Reads the 32-bit accumulators that sf_refocus leaves behind, because rounding to bytes hides all
// taps below 1/510; *result is valid for SF_OK only.
sf_status MeasureEngineKernel(const EngineProbe& probe, EngineKernel* result);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_
