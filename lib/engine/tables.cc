// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/tables.h"

namespace starfocus {
namespace {

// Upper bound of the number of points of the opening that are counted to compute one weight.
constexpr int64_t kAperturePoints = 256;

}  // namespace

int32_t LargestN(const starfocus_config& config, const Renderer& renderer, Demand demand,
                 double r_max) {
  return ScaleViews(renderer.view_count(r_max + 1, demand), config.tuning.n_scale);
}

void TakeTables(const starfocus_config& config, Arena* arena, Tables* tables) {
  const bool full = Has(config, STARFOCUS_FEATURE_SHAPES);
  const auto weights_of = [&](int32_t n) {
    return full ? FullApertureSize(n) : ViewWeightsSize(n);
  };
  for (int32_t k = 0; k < RendererCount(config); ++k) {
    const int32_t last = LargestN(config, *kRenderers[k], Demand::kRing, config.max_blur);
    size_t weights = 0;
    for (int32_t n = 0; n <= last; ++n) weights += weights_of(n);
    tables->apertures[k].apertures = arena->Take<ViewWeights>(static_cast<size_t>(last) + 1);
    tables->apertures[k].weights = arena->Take<uint16_t>(weights);
  }
  const int32_t benchmark_n = ViewsOfBenchmark(config.max_blur);
  const auto steps = static_cast<size_t>(BlurStepCount(config.max_blur));
  tables->benchmark_weights = arena->Take<uint16_t>(weights_of(benchmark_n));
  tables->psfs = arena->Take<Psf>(steps);
  tables->blur_weights = arena->Take<uint16_t>(BlurWeightCount(full, config.max_blur));
}

void SetOpening(const ApertureShape& opening, Tables* tables) {
  const bool same = tables->mean_square != 0 && AreAlike(opening, tables->opening);
  tables->opening = opening;
  if (same) return;
  for (ApertureTable& table : tables->apertures) {
    table.count = 0;
    table.used = 0;
  }
  tables->blur_steps = 0;
  tables->mean_square = MeanSquare(opening);
}

starfocus_status MakeApertures(const Renderer& renderer, int32_t last, CallProgress* call_progress,
                               Tables* tables) {
  ApertureTable& table = tables->apertures[renderer.index];
  CancelToken cancel(call_progress);
  for (; table.count <= last; ++table.count) {
    const size_t size = ViewWeightsSize(tables->opening, table.count);
    if (!cancel.Spend(static_cast<int64_t>(size) * kAperturePoints))
      return STARFOCUS_ERROR_CANCELLED;
    table.apertures[table.count] =
        renderer.make_aperture(table.count, tables->opening, table.weights + table.used);
    table.used += size;
  }
  return STARFOCUS_OK;
}

starfocus_status MakePsfs(int32_t steps, CallProgress* call_progress, Tables* tables) {
  if (steps <= tables->blur_steps) return STARFOCUS_OK;
  CancelToken cancel(call_progress);
  tables->blur_steps = MakePsfs(tables->blur_steps, steps, tables->opening, &cancel,
                                tables->blur_weights, tables->psfs);
  return tables->blur_steps == steps ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED;
}

}  // namespace starfocus
