// SPDX-License-Identifier: Apache-2.0
// Measures the PSF of the running engine, which is the engine's response to one white pixel on a
// flat surface.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_

#include "examples/lab/analysis/sampled_psf.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus::analysis {

// Parameters of a PSF measurement at aperture radius u_t = 1.
struct EngineProbe {
  // d - d_t of the surface in pixels, |r| <= 60. If r is negative, the surface is behind the focus.
  double r;
  // Largest blur radius of the disparity range in pixels, at least |r|. Frame mode computes N from
  // r_max.
  double r_max;
  starfocus_mode mode;          // STARFOCUS_MODE_FRAME or STARFOCUS_MODE_BLOCK.
  starfocus_renderer renderer;  // STARFOCUS_RENDERER_LINE_SCAN or STARFOCUS_RENDERER_SLICES.
  int layer;                    // Largest L that block mode may use, in [0, 2].
};

struct EnginePsf {
  // Mean PSF over all positions of the white pixel, normalised so that the taps sum to 1.
  SampledPsf psf;
  double aliasing;  // Mean squared variation of the PSF over the positions of the white pixel,
                    // caused by layers.
  int n;            // N that the engine chose.
  int layer;        // L that the engine chose.
};

// Measures the PSF. At layer 0, the function reads the 32-bit accumulators that starfocus_refocus
// leaves in memory, because rounding to bytes hides all taps below 1/510. At other layers, the
// function reads the samples before the rounding to bytes, with a resolution of 1/64 grey level.
// The output *result is valid only if the function returns STARFOCUS_OK. Returns
// STARFOCUS_ERROR_STATE if the engine split the picture into blocks.
starfocus_status MeasureEnginePsf(const EngineProbe& probe, EnginePsf* result);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_
