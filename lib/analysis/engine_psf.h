// SPDX-License-Identifier: Apache-2.0
// The PSF of the running engine: its answer to one white pixel on a flat surface.
#ifndef STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_
#define STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_

#include "lib/analysis/sampled_psf.h"
#include "starfocus/starfocus.h"

namespace starfocus::analysis {

// What to measure, with u_t = 1.
struct EngineProbe {
  double r;      // d - d_t of the surface in pixels, |r| <= 60; the sign tells the direction
  double r_max;  // largest blur radius of the disparity range, >= |r|: frame mode takes N from it
  starfocus_mode mode;          // STARFOCUS_MODE_FRAME or STARFOCUS_MODE_BLOCK
  starfocus_renderer renderer;  // STARFOCUS_RENDERER_LINE_SCAN or STARFOCUS_RENDERER_SLICES
  int layer;                    // the largest L that block mode may use, in [0, 2]
};

struct EnginePsf {
  SampledPsf psf;   // unit white: taps sum to 1; the mean over all places of the white pixel
  double aliasing;  // of layers: how far it varies with that place, in mean square
  int n;            // N the engine chose
  int layer;        // L the engine chose
};

// At layer 0 reads the 32-bit accumulators that starfocus_refocus leaves behind, because rounding
// to bytes hides all taps below 1/510; from a layer, samples to 1/64 gray level before they are
// rounded. *result is valid for STARFOCUS_OK only. STARFOCUS_ERROR_STATE: the picture was split
// into blocks.
starfocus_status MeasureEnginePsf(const EngineProbe& probe, EnginePsf* result);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_ENGINE_KERNEL_H_
