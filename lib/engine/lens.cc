#include "lib/engine/lens.h"

#include "lib/base/rules.h"
#include "lib/engine/stripe_layers.h"

namespace starfocus {
namespace {

// Blur radius of the configured range's farther end.
double LargestBlur(const sf_config& config, const sf_params& params) {
  const double nearer = config.disparity_max - params.focus;
  const double farther = params.focus - config.disparity_min;
  return params.aperture * (nearer > farther ? nearer : farther);
}

}  // namespace

sf_status SetLens(const sf_params& params, EngineState* engine) {
  const sf_config& config = engine->config;
  const double r_max = LargestBlur(config, params);
  if (r_max > config.max_blur) return SF_ERROR_BLUR_TOO_LARGE;
  engine->params = params;
  engine->region = RegionOf(config, params);
  engine->reach = GetReach(r_max);
  const bool subapertures = UsesSubapertures(*engine);
  if (IsBenchmark(*engine)) {
    engine->aperture = (subapertures ? MakeSubapertures : MakeAperture)(
        ViewsOfBenchmark(r_max), engine->fall_off, engine->benchmark_weights);
  } else {
    const int32_t n = subapertures ? ViewsBySubaperture(r_max) : ViewsByPaper(r_max);
    engine->aperture =
        (subapertures ? engine->subapertures : engine->apertures)[ScaleViews(n, config.n_scale)];
  }
  const ViewGrid grid = MakeViewGrid(engine->aperture, params.focus, params.aperture, 0, false);
  engine->scale = {grid.focus, grid.step};
  const bool gathers = IsBlockMode(*engine) && subapertures && config.gather != 0;
  if (params.mode == SF_MODE_BLUR || gathers) {
    const int32_t steps = BlurStepCount(gathers && r_max > kMaxGather ? kMaxGather : r_max);
    if (steps > engine->blur_steps) {
      MakeBlurKernels(engine->blur_steps, steps, engine->fall_off, engine->blur_weights,
                      engine->blur_kernels);
      engine->blur_steps = steps;
    }
  }
  engine->report = sf_report();
  engine->report.r_max = r_max;
  engine->report.largest_block = config.largest_block;
  DropCounts(engine);
  engine->prepared = false;
  engine->changes.active = false;
  ForgetStripe(engine);
  ForgetLayers(engine);
  return SF_OK;
}

}  // namespace starfocus
