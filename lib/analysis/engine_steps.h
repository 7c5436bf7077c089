// SPDX-License-Identifier: Apache-2.0
// Compares the PSFs of the running engine with the theory, and explains the differences.
#ifndef STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
#define STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_

#include <string>

#include "lib/analysis/engine_psf.h"

namespace starfocus::analysis {

// Theoretical values for blur radius r refocused at layer L. `error` is the SSE (10) of the ideal
// PSF at r / 2^L through the layers, against the ideal PSF (4) at r. `aliasing` is (11). Both are 0
// at layer 0.
struct LayerTheory {
  double error;
  double aliasing;
};
LayerTheory MakeLayerTheory(double r, int layer);

// SSE (8) of several PSFs against the ideal PSF (4) at one r. If L > 0, all of them go through the
// layers.
struct EngineStep {
  double r;             // signed
  int n;                // N that the engine chose
  int layer;            // L that the engine chose
  bool wide;            // subapertures may be wider than a pixel
  double engine;        // of the measured PSF
  double star;          // of StarPsf
  double subapertures;  // of SubaperturePsf
  double paper;         // of PaperPsf
  // SSE of subapertures at most a pixel wide, with every view spread along both axes.
  double both_axes;
  double apart;     // squared difference of the measured PSF and StarPsf
  double aliasing;  // measured aliasing
};

starfocus_status MeasureStep(const EngineProbe& probe, EngineStep* step);

// Largest difference between the measured PSF and StarPsf that rounding explains. Slices have 7
// fractional bits of a gray level, weights of views about 10, and samples of layers 6. A pixel that
// is spread has only a few levels left.
inline constexpr double kExplained[] = {1.1e-5, 2e-5, 2e-5};  // by layer

// Explains why step.engine exceeds kThreshold; empty if it does not. Starts with "unexplained" if
// the measured PSF differs from the one that the engine's description gives.
std::string Explain(const EngineStep& step);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
