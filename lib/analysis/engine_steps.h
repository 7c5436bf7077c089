// The running engine's kernels beside the theory, and why they differ.
#ifndef STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
#define STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_

#include <string>

#include "lib/analysis/engine_kernel.h"

namespace starfocus::analysis {

// SSE (8) against the ideal kernel (4) at one r.
struct EngineStep {
  double r;       // signed
  int n;          // N the engine chose
  double engine;  // of the measured kernel
  double star;    // of StarKernel
  double cells;   // of CellKernel
  double paper;   // of PaperKernel
  double apart;   // squared difference of the measured kernel and StarKernel
};

sf_status MeasureStep(const EngineProbe& probe, EngineStep* step);

// Measured kernel and StarKernel may be this far apart: bytes of type A lines are rounded.
inline constexpr double kExplained = 1e-5;

// Why step.engine exceeds kThreshold; empty when it does not. Starts with "unexplained" when the
// measured kernel is not the one the engine's description gives.
std::string Explain(const EngineStep& step);

}  // namespace starfocus::analysis

#endif  // STARFOCUS_LIB_ANALYSIS_ENGINE_STEPS_H_
