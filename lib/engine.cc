#include "lib/engine.h"

#include "lib/rules.h"

namespace starfocus {
namespace {

int32_t CeilPixels(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

double AbsDouble(double value) { return value < 0 ? -value : value; }

// A pixel's blur, half a pixel of rounding and the neighbour of its aperture cell.
int32_t BorderOf(double r_max) { return CeilPixels(r_max) + 2; }

struct StripeJob {
  EngineState* engine;
  int32_t y;
  uint8_t* out;
  size_t out_stride;
};

void RefocusBlock(void* data, int32_t index, int32_t worker) {
  const auto& stripe = *static_cast<const StripeJob*>(data);
  EngineState& engine = *stripe.engine;
  const int32_t side = engine.config.largest_block;
  StarJob job;
  job.window = &engine.window;
  job.grid = &engine.grid;
  job.kernels = engine.kernels;
  job.rect = {index * side, stripe.y, Min(side, engine.config.width - index * side),
              Min(side, engine.config.height - stripe.y)};
  job.border = {engine.border, engine.border, engine.border, engine.border};
  StarScratch* scratch = &engine.workers[worker];
  RefocusRectangle(job, scratch);
  const size_t samples = 3 * static_cast<size_t>(job.rect.width);
  for (int32_t row = 0; row < job.rect.height; ++row) {
    engine.kernels->finish(scratch->accumulators[0] + static_cast<size_t>(row) * samples, samples,
                           engine.grid.aperture.sum_bits,
                           stripe.out + static_cast<size_t>(row) * stripe.out_stride +
                               3 * static_cast<size_t>(job.rect.x));
  }
}

}  // namespace

Reach GetReach(const sf_config& config) {
  Reach reach;
  reach.stripe = config.largest_block;
  reach.border = BorderOf(config.max_blur);
  // A hole anywhere in the extended stripe is read from a side view at most its disparity away
  // from a place within the blur radius.
  const double disparity = AbsDouble(config.disparity_min) > AbsDouble(config.disparity_max)
                               ? AbsDouble(config.disparity_min)
                               : AbsDouble(config.disparity_max);
  reach.views = reach.stripe + 2 * (2 * reach.border + CeilPixels(disparity) + 1);
  reach.disparity = config.streaming != 0 ? reach.views : reach.stripe + 2 * reach.border;
  return reach;
}

sf_status SetLens(const sf_params& params, EngineState* engine) {
  const sf_config& config = engine->config;
  const double to_min = AbsDouble(config.disparity_min - params.focus);
  const double to_max = AbsDouble(config.disparity_max - params.focus);
  const double r_max = params.aperture * (to_min > to_max ? to_min : to_max);
  if (r_max > config.max_blur) return SF_ERROR_BLUR_TOO_LARGE;
  const int32_t n =
      params.mode == SF_MODE_BENCHMARK ? ViewsOfBenchmark(r_max) : ViewsByPaper(r_max);
  const Aperture aperture = MakeAperture(n, engine->fall_off, engine->aperture_weights);
  engine->grid = MakeViewGrid(aperture, params.focus, params.aperture, 0, config.views == 17);
  engine->border = BorderOf(r_max);
  engine->report.r_max = r_max;
  engine->report.n = n;
  engine->report.rendered_views = aperture.views;
  engine->report.rendered_samples = 3 * static_cast<uint64_t>(aperture.views) *
                                    static_cast<uint64_t>(config.width) *
                                    static_cast<uint64_t>(config.height);
  engine->disparity_rows = 0;
  return SF_OK;
}

sf_status PushDisparity(const float* row, EngineState* engine) {
  const sf_config& config = engine->config;
  const auto width = static_cast<size_t>(config.width);
  int16_t* out = engine->disparity.Row(engine->disparity_rows);
  if (!engine->kernels->convert_disparity(row, width, config.disparity_min, config.disparity_max,
                                          out)) {
    for (size_t x = 0; x < width; ++x) {
      if (!(row[x] - row[x] == 0.0f)) return SF_ERROR_NOT_FINITE;
    }
    return SF_ERROR_DISPARITY;
  }
  ++engine->disparity_rows;
  return SF_OK;
}

sf_status RefocusStripe(EngineState* engine, int32_t y, uint8_t* out, size_t out_stride,
                        const Runner& runner) {
  const int32_t side = engine->config.largest_block;
  StripeJob stripe = {engine, y, out, out_stride};
  const int32_t blocks = (engine->config.width + side - 1) / side;
  if (runner.run != nullptr) {
    return runner.run(runner.data, RefocusBlock, &stripe, blocks) == 0 ? SF_OK : SF_ERROR_RUNNER;
  }
  for (int32_t block = 0; block < blocks; ++block) RefocusBlock(&stripe, block, 0);
  return SF_OK;
}

}  // namespace starfocus
