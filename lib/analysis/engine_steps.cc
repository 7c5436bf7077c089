#include "lib/analysis/engine_steps.h"

#include <algorithm>
#include <cmath>

#include "lib/analysis/aperture.h"
#include "lib/analysis/ideal.h"
#include "lib/analysis/selection.h"
#include "lib/analysis/star_kernel.h"

namespace starfocus::analysis {

sf_status MeasureStep(const EngineProbe& probe, EngineStep* step) {
  EngineKernel measured = {Kernel(0), 0};
  const sf_status status = MeasureEngineKernel(probe, &measured);
  if (status != SF_OK) return status;
  const double r = std::fabs(probe.r), theta = kDefaultTheta;
  const int n = measured.n;
  const Kernel ideal = IdealKernel(r, theta), star = StarKernel(r, n, theta);
  const auto error = [&](const Kernel& kernel) { return SquaredError(kernel, ideal); };
  *step = {probe.r,
           n,
           error(measured.kernel),
           error(star),
           error(CellKernel(r, n, theta)),
           n == 0 ? error(star) : error(PaperKernel(r, n, theta)),
           SquaredError(measured.kernel, star)};
  return SF_OK;
}

std::string Explain(const EngineStep& step) {
  if (step.engine <= kThreshold) return "";
  if (step.apart > kExplained) return "unexplained: not the kernel the engine is meant to have";
  const double r = std::fabs(step.r), width = std::min(r / step.n, 1.0);
  // Of the causes, from the most to the least fundamental, the first that suffices.
  if (step.cells > kThreshold)
    return "too few views: exact aperture cells exceed it with this N too";
  const Kernel both_axes = ViewKernel(r, step.n, kDefaultTheta, width);
  if (SquaredError(both_axes, IdealKernel(r, kDefaultTheta)) > kThreshold) {
    return "cells one pixel wide where views lie r / N > 1 apart";
  }
  return r > step.n ? "type B views spread along their diagonal only, cells one pixel wide"
                    : "type B views spread along their diagonal only";
}

}  // namespace starfocus::analysis
