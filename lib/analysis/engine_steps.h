// SPDX-License-Identifier: Apache-2.0
// The running engine's PSFs beside the theory, and why they differ.
#ifndef STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
#define STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_

#include <string>

#include "lib/analysis/engine_psf.h"

namespace starfocus::analysis {

// What theory says of blur radius r refocused at layer L: SSE against the ideal PSF (4) at r of
// the ideal PSF at r / 2^L through the layers, (10), and its aliasing, (11). Both are 0 at layer
// 0.
struct LayerTheory {
  double error;
  double aliasing;
};
LayerTheory MakeLayerTheory(double r, int layer);

// SSE (8) against the ideal PSF (4) at one r, all through the layers where L > 0.
struct EngineStep {
  double r;             // signed
  int n;                // N the engine chose
  int layer;            // L the engine chose
  bool wide;            // subapertures may be wider than a pixel
  double engine;        // of the measured PSF
  double star;          // of StarPsf
  double subapertures;  // of SubaperturePsf
  double paper;         // of PaperPsf
  double both_axes;     // of subapertures at most a pixel wide, every view spread along both axes
  double apart;         // squared difference of the measured PSF and StarPsf
  double aliasing;      // measured
};

starfocus_status MeasureStep(const EngineProbe& probe, EngineStep* step);

// Measured PSF and StarPsf may be this far apart: slices have 7 fractional bits of a gray
// level, the weights of views 10 or so, and the samples of layers 6, of the few levels that a
// pixel is left with when it is spread.
inline constexpr double kExplained[] = {1.1e-5, 2e-5, 2e-5};  // by layer

// Why step.engine exceeds kThreshold; empty when it does not. Starts with "unexplained" when the
// measured PSF is not the one the engine's description gives.
std::string Explain(const EngineStep& step);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
