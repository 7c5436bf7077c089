// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/lens.h"

#include "lib/base/rules.h"
#include "lib/base/view_grid.h"
#include "lib/base/view_set.h"
#include "lib/filter/blur.h"

namespace starfocus {
namespace {

// The one aperture of the frame modes. The benchmark's is made in memory of its own.
Aperture FrameAperture(const sf_config& config, const Tables& tables, const Lens& lens) {
  const bool subapertures = UsesSubapertures(lens);
  if (IsBenchmark(lens)) {
    const int32_t n = ViewsOfBenchmark(lens.r_max);
    return subapertures ? MakeSubapertures(n, tables.opening, tables.benchmark_weights)
                        : MakeAperture(n, tables.opening, tables.benchmark_weights);
  }
  const int32_t n = subapertures ? ViewsBySubaperture(lens.r_max, DemandOf(tables.opening))
                                 : ViewsByPaper(lens.r_max);
  return (subapertures ? tables.subapertures : tables.apertures)[ScaleViews(n, config.n_scale)];
}

}  // namespace

Rect RegionOf(const sf_config& config, const sf_params& params) {
  const sf_region& region = params.region;
  if (IsWhole(region)) return {0, 0, config.width, config.height};
  return {region.x, region.y, region.width, region.height};
}

int32_t LastGatherStep(const Lens& lens) { return BlurStepCount(LargestGather(lens.r_max)) - 1; }

double LargestBlur(const sf_config& config, const sf_params& params) {
  const double nearer = config.disparity_max - params.focus;
  const double farther = params.focus - config.disparity_min;
  return params.aperture * (nearer > farther ? nearer : farther);
}

sf_status MakeLens(const sf_config& config, const sf_params& params, Watch* watch, Tables* tables,
                   Lens* lens) {
  const double r_max = LargestBlur(config, params);
  if (r_max > config.max_blur) return SF_ERROR_BLUR_TOO_LARGE;
  lens->params = params;
  // One view shows nothing behind edges: line scans would put a halo there, as wide as the blur.
  if (params.rule == SF_RULE_DEFAULT && (config.views == 1 || !HasStar(config))) {
    lens->params.rule = SF_RULE_SUBAPERTURE;
  }
  lens->region = RegionOf(config, params);
  lens->r_max = r_max;
  lens->reach = GetReach(r_max);
  lens->slice_limits = LimitsOfSlices(config.largest_block, r_max);
  lens->aperture = FrameAperture(config, *tables, *lens);
  const ViewGrid grid = MakeViewGrid(lens->aperture, params.focus, params.aperture, 0, false);
  lens->scale = {grid.focus, grid.step};
  if (Gathers(config, *lens)) return MakeBlurKernels(LastGatherStep(*lens) + 1, watch, tables);
  if (params.mode == SF_MODE_BLUR) return MakeBlurKernels(BlurStepCount(r_max), watch, tables);
  return SF_OK;
}

}  // namespace starfocus
