// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/engine.h"

#include <cstring>

#include "lib/engine/borders.h"

namespace starfocus {
namespace {

void Add(const starfocus_layer_report& part, starfocus_layer_report* sum) {
  sum->blocks += part.blocks;
  sum->pixels += part.pixels;
  sum->views += part.views;
  sum->rendered_samples += part.rendered_samples;
  sum->predicted_ps += part.predicted_ps;
  sum->measured_ns += part.measured_ns;
}

void Add(const Counts& counts, starfocus_report* report) {
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    Add(counts.layers[layer], &report->layers[layer]);
    report->rendered_samples += counts.layers[layer].rendered_samples;
  }
  report->copied_pixels += counts.copied_pixels;
  report->gathered_pixels += counts.gathered_pixels;
  report->unknown_pixels += counts.unknown_pixels;
}

}  // namespace

starfocus_status SetLens(const starfocus_params& params, EngineState* engine) {
  const starfocus_status status =
      MakeLens(engine->config, params, &engine->jobs->call_progress, engine->tables, &engine->lens);
  if (status != STARFOCUS_OK) return status;
  engine->report = starfocus_report();
  engine->report.r_max = engine->lens.r_max;
  engine->report.superblock = engine->config.superblock;
  DropCounts(engine);
  engine->stripe.changes.active = false;
  ForgetStripe(&engine->stripe);
  ForgetLayers(engine->config, &engine->layers);
  return STARFOCUS_OK;
}

void TakeCounts(EngineState* engine) {
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    Add(engine->scratch[worker].counts, &engine->report);
  }
  DropCounts(engine);
}

void DropCounts(EngineState* engine) {
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    engine->scratch[worker].counts = Counts();
  }
}

void ForgetStripe(StripeState* stripe) {
  std::memset(stripe->map.layers, kNoLayer, static_cast<size_t>(stripe->map.columns));
  stripe->plan.all_measured = false;
  for (int32_t& done : stripe->coverage.done) done = -1;
}

void ForgetLayers(const starfocus_config& config, StripeLayers* layers) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    LayerPlane& plane = layers->planes[layer];
    plane.width = LayerSize(config.width, layer);
    plane.height = LayerSize(config.height, layer);
    // The ring holds the largest number of rows that a stripe may read, so that rows of the
    // previous stripe are kept.
    plane.samples.rows = LayerRows(config, layer);
    plane.rows = {0, 0};
    std::memset(layers->needed[layer], 0, static_cast<size_t>(Columns(config)));
  }
}

}  // namespace starfocus
