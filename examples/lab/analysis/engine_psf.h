// SPDX-License-Identifier: Apache-2.0
// Measures the PSF of the running engine, which is the engine's response to one white pixel on a
// flat surface, and compares it with the prediction of the analysis, step by step.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_

#include <string>

#include "examples/lab/analysis/ideal.h"
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

// Compares the PSFs of the running engine with the theory, and explains the differences.

// Theoretical errors of a blur of radius r that is rendered at layer L. `error` is the SSE (10)
// between two PSFs: the ideal PSF for r / 2^L with the layers' filters, and the ideal PSF (4).
// `aliasing` is (11). `error` and `aliasing` are 0 at layer 0.
struct LayerTheory {
  double error;
  double aliasing;
};
LayerTheory MakeLayerTheory(double r, int layer);

// SSE (8) of several PSFs with respect to the ideal PSF (4) for one r. If L > 0, each PSF except
// the ideal PSF includes the layers' filters.
struct EngineStep {
  double r;             // Signed.
  int n;                // N that the engine chose.
  int layer;            // L that the engine chose.
  bool wide;            // True if subapertures may be wider than a pixel.
  double engine;        // SSE of the measured PSF.
  double star;          // SSE of StarPsf.
  double subapertures;  // SSE of SubaperturePsf.
  double paper;         // SSE of PaperPsf.
  // SSE of the PSF of subapertures that are at most a pixel wide, with every view spread along both
  // axes.
  double both_axes;
  double apart;     // Sum of squared differences between the measured PSF and StarPsf.
  double aliasing;  // Measured aliasing.
};

starfocus_status MeasureStep(const EngineProbe& probe, EngineStep* step);

// Largest value of EngineStep::apart that rounding explains, by layer. Slices have 7 fractional
// bits of a grey level, weights of views about 10 bits, and samples of layers 6 fractional bits.
// The blur spreads the light of a pixel so widely that only a few grey levels reach each pixel of
// the result.
inline constexpr double kExplained[] = {1.1e-5, 2e-5, 2e-5};  // by layer

// If step.engine exceeds kThreshold, returns an explanation; otherwise, returns an empty string.
// The explanation starts with "unexplained" if the measured PSF differs from StarPsf by more than
// rounding explains.
std::string Explain(const EngineStep& step);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_PSF_H_
