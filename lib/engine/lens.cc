// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/lens.h"

#include <cstring>

#include "lib/base/problem.h"
#include "lib/optics/view_grid.h"
#include "lib/optics/view_set.h"

namespace starfocus {

namespace {

// Upper bound of the number of points of the opening that are counted to compute one weight.
constexpr int64_t kAperturePoints = 256;

}  // namespace

int32_t LargestN(const FullConfig& config, const Renderer& renderer, Demand demand, double r_max) {
  return ScaleViews(renderer.view_count(r_max + 1, demand), config.tuning.n_scale);
}

void TakeTables(const FullConfig& config, Arena* arena, Tables* tables) {
  const bool full = Has(config, STARFOCUS_FEATURE_SHAPES);
  const auto weights_of = [&](int32_t n) {
    return full ? FullApertureSize(n) : ViewWeightsSize(n);
  };
  for (int32_t k = 0; k < RendererCount(config); ++k) {
    const int32_t last = LargestN(config, RendererAt(config, k), Demand::kRing, config.max_blur);
    size_t weights = 0;
    for (int32_t n = 0; n <= last; ++n) weights += weights_of(n);
    tables->apertures[k].weights_by_n = arena->Take<ViewWeights>(static_cast<size_t>(last) + 1);
    tables->apertures[k].weights = arena->Take<uint16_t>(weights);
  }
  const int32_t benchmark_n = ViewsOfBenchmark(config.max_blur);
  const auto steps = static_cast<size_t>(PsfCount(config.max_blur));
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
    table.weights_by_n[table.count] =
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

namespace {

// Returns the largest number below `value` > 0. Also correct for numbers without full precision,
// which a multiplication by less than 1 may not change.
double NextBelow(double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  --bits;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

// Returns the largest distance of a configured disparity from the range in focus.
double LargestDistance(const FullConfig& config, const starfocus_params& params) {
  const double nearer = config.disparity_max - (params.focus + params.focus_nearer);
  const double farther = params.focus - params.focus_farther - config.disparity_min;
  const double distance = nearer > farther ? nearer : farther;
  return distance > 0 ? distance : 0;
}

// Returns the renderer of a lens. By default, one view is rendered with slices, because line scans
// of one view show a halo as wide as the blur.
const Renderer& RendererOf(const FullConfig& config, const FullParams& params) {
  const bool by_default = params.renderer == STARFOCUS_RENDERER_AUTO &&
                          params.mode == STARFOCUS_MODE_FRAME && config.views > 1 &&
                          HasStar(config);
  const bool is_paper = params.renderer == STARFOCUS_RENDERER_LINE_SCAN || by_default;
  return RendererAt(config, is_paper ? RendererCount(config) - 1 : kSliceRenderer.index);
}

// Returns the aperture of a mode that uses one number of views for all blocks. The aperture of
// benchmark mode has its own memory. STARFOCUS_MODE_BLUR reads only the centre view and uses N = 0.
ViewWeights FrameWeights(const FullConfig& config, const Tables& tables, const Lens& lens) {
  const Renderer& renderer = *lens.renderer;
  if (lens.params.mode == STARFOCUS_MODE_BLUR) return lens.weights_by_n[0];
  if (IsBenchmark(lens)) {
    return renderer.make_aperture(ViewsOfBenchmark(lens.r_max), tables.opening,
                                  tables.benchmark_weights);
  }
  const int32_t n = renderer.view_count(lens.r_max, DemandOf(tables.opening));
  return lens.weights_by_n[ScaleViews(n, config.tuning.n_scale)];
}

}  // namespace

Rect RegionOf(const FullConfig& config, const FullParams& params) {
  const starfocus_region& region = params.region;
  if (IsWhole(region)) return {0, 0, config.width, config.height};
  return {region.x, region.y, region.width, region.height};
}

int32_t LastGatherPsf(const Lens& lens) { return PsfCount(LargestGather(lens.r_max)) - 1; }

double LargestBlur(const FullConfig& config, const FullParams& params) {
  return params.aperture * LargestDistance(config, params);
}

double LargestAperture(const FullConfig& config, const starfocus_params& params) {
  const double distance = LargestDistance(config, params), most = config.max_blur;
  double aperture = distance <= most ? 1 : most / distance;
  // The rounded quotient may be too large by one unit in the last place. The loop ends for any
  // quotient, because each step makes `aperture` smaller, and the product with 0 is not too large.
  while (aperture * distance > most) aperture = NextBelow(aperture);
  return aperture;
}

starfocus_status CheckBlur(const FullConfig& config, const FullParams& params) {
  Checker check(config.problem);
  check.Need(LargestBlur(config, params) <= config.max_blur, STARFOCUS_ERROR_BLUR,
             {"aperture", params.aperture},
             {"at most max_blur over the largest distance of a configured disparity from the focus",
              0, LargestAperture(config, params)});
  return check.status();
}

starfocus_status MakeLens(const FullConfig& config, const FullParams& params,
                          CallProgress* call_progress, Tables* tables, Lens* lens) {
  const double r_max = LargestBlur(config, params);
  const starfocus_status fits = CheckBlur(config, params);
  if (fits != STARFOCUS_OK) return fits;
  SetOpening(ShapeOf(params), tables);
  lens->params = params;
  lens->region = RegionOf(config, params);
  lens->renderer = &RendererOf(config, params);
  lens->r_max = r_max;
  lens->borders = AddBorders(config, r_max, IsDeblocking(config, *lens));
  // Benchmark mode has its own aperture, and STARFOCUS_MODE_BLUR uses only the aperture of N = 0.
  const bool has_own = IsBenchmark(*lens) || params.mode == STARFOCUS_MODE_BLUR;
  lens->largest_n =
      LargestN(config, *lens->renderer, DemandOf(tables->opening), has_own ? 0 : r_max);
  const starfocus_status status =
      MakeApertures(*lens->renderer, lens->largest_n, call_progress, tables);
  if (status != STARFOCUS_OK) return status;
  lens->weights_by_n = tables->apertures[lens->renderer->index].weights_by_n;
  lens->frame_weights = FrameWeights(config, *tables, *lens);
  const FocusRange focus = MakeFocusRange(params.focus, params.focus_nearer, params.focus_farther);
  const ViewGrid grid = MakeViewGrid(lens->frame_weights, focus, params.aperture, 0);
  lens->scale = {grid.focus, grid.step};
  if (Gathers(config, *lens)) return MakePsfs(LastGatherPsf(*lens) + 1, call_progress, tables);
  if (params.mode == STARFOCUS_MODE_BLUR) return MakePsfs(PsfCount(r_max), call_progress, tables);
  return STARFOCUS_OK;
}

}  // namespace starfocus
