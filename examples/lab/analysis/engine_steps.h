// SPDX-License-Identifier: Apache-2.0
// Compares the PSFs of the running engine with the theory, and explains the differences.
#ifndef STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_STEPS_H_
#define STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_STEPS_H_

#include <string>

#include "examples/lab/analysis/engine_psf.h"

namespace starfocus::analysis {

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

#endif  // STARFOCUS_EXAMPLES_LAB_ANALYSIS_ENGINE_STEPS_H_
