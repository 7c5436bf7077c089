// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/analysis/engine_steps.h"

#include <algorithm>
#include <cmath>

#include "examples/lab/analysis/aperture.h"
#include "examples/lab/analysis/half_band.h"
#include "examples/lab/analysis/ideal.h"
#include "examples/lab/analysis/selection.h"
#include "examples/lab/analysis/star_psf.h"
#include "examples/lab/analysis/subsampled.h"
#include "starfocus/experimental.h"

namespace starfocus::analysis {

namespace {

SampledPsf Through(SampledPsf psf, int layer) {
  for (int k = 0; k < layer; ++k) psf = ThroughLayer(psf, kBetaDown);
  return psf;
}

}  // namespace

LayerTheory MakeLayerTheory(double r, int layer) {
  if (layer == 0) return {0, 0};
  const SampledPsf small = IdealPsf(r / (1 << layer), kDefaultTheta);
  return {SquaredError(Through(small, layer), IdealPsf(r, kDefaultTheta)),
          LayerAliasing(small, layer, kBetaDown)};
}

starfocus_status MeasureStep(const EngineProbe& probe, EngineStep* step) {
  EnginePsf measured = {SampledPsf(0), 0, 0, 0};
  const starfocus_status status = MeasureEnginePsf(probe, &measured);
  if (status != STARFOCUS_OK) return status;
  const double theta = kDefaultTheta;
  const int n = measured.n, layer = measured.layer;
  const double r = std::fabs(probe.r), small = r / (1 << layer);
  const bool wide = probe.renderer == STARFOCUS_RENDERER_SLICES;
  const SampledPsf ideal = IdealPsf(r, theta);
  const SampledPsf star =
      Through(StarPsf(small, n, theta, wide ? Subapertures::kWide : Subapertures::kNarrow), layer);
  const auto error = [&](const SampledPsf& psf) {
    return SquaredError(Through(psf, layer), ideal);
  };
  const SampledPsf both =
      n == 0 ? IdealPsf(0, theta) : ViewPsf(small, n, theta, std::clamp(small / n, 1e-6, 1.0));
  *step = {probe.r,
           n,
           layer,
           wide,
           SquaredError(measured.psf, ideal),
           SquaredError(star, ideal),
           error(SubaperturePsf(small, n, theta)),
           error(n == 0 ? IdealPsf(0, theta) : PaperPsf(small, n, theta)),
           error(both),
           SquaredError(measured.psf, star),
           measured.aliasing};
  return STARFOCUS_OK;
}

std::string Explain(const EngineStep& step) {
  if (step.engine <= kThreshold) return "";
  if (step.apart > kExplained[step.layer]) {
    return "unexplained: the measured PSF differs from StarPsf";
  }
  // Tests possible causes from the most to the least fundamental, and returns the first cause that
  // explains the error.
  const double r = std::fabs(step.r);
  if (MakeLayerTheory(r, step.layer).error > kThreshold) {
    return "the filters between layers raise the error of the ideal PSF above 1e-3";
  }
  if (step.subapertures > kThreshold) {
    return "too few views: with this N, the error of exact subapertures exceeds 1e-3";
  }
  if (step.wide)
    return "wide subapertures are boxes; boxes above 3 pixels cover whole pixels and are "
           "interpolated";
  if (step.both_axes > kThreshold) {
    return "subapertures are one pixel wide, but the views are r / N > 1 pixels apart";
  }
  return r > step.n * (1 << step.layer) ? "type B views are spread along their diagonal only, and "
                                          "subapertures are one pixel wide"
                                        : "type B views are spread along their diagonal only";
}

}  // namespace starfocus::analysis
