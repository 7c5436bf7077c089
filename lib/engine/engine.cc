#include "lib/engine/engine.h"

#include <cstring>

namespace starfocus {
namespace {

int32_t CeilPixels(double value) {
  const auto whole = static_cast<int32_t>(value);
  return value > whole ? whole + 1 : whole;
}

double AbsDouble(double value) { return value < 0 ? -value : value; }

double MaxDouble(double a, double b) { return a > b ? a : b; }

}  // namespace

Rect RegionOf(const sf_config& config, const sf_params& params) {
  const sf_region& region = params.region;
  if (IsWhole(region)) return {0, 0, config.width, config.height};
  return {region.x, region.y, region.width, region.height};
}

Reach GetReach(double max_blur) {
  // A cell reaches at most r and half a pixel of rounding beyond itself, or a layer's margin more;
  // its pixels then lie less than a cell further away.
  const int32_t splat = CeilPixels(max_blur) + 1 + kLayerMargin[2];
  Reach reach;
  reach.border = CeilPixels(max_blur) + kCellSize + 2;
  reach.cells = (splat + kCellSize - 1) / kCellSize + 1;
  // And the taps of two downsampling filters.
  reach.rows = (reach.cells + 1) * kCellSize + 16;
  return reach;
}

int32_t LayerRows(const sf_config& config, int layer) {
  int32_t rows = config.largest_block + 2 * GetReach(config.max_blur).rows;
  for (; layer > 0; --layer) rows = rows / 2 + 4;
  return rows;
}

int32_t SideReach(const sf_config& config, double max_blur) {
  // A hole is read at most its disparity away from a place within the blur radius, by a filter of
  // 7 taps at most.
  const double disparity =
      MaxDouble(AbsDouble(config.disparity_min), AbsDouble(config.disparity_max));
  return GetReach(max_blur).rows + CeilPixels(max_blur) + CeilPixels(disparity) + 8;
}

void MakeTables(EngineState* engine) {
  engine->fall_off = ApertureFallOff(engine->config.theta);
  uint16_t* weights = engine->aperture_weights;
  for (int32_t n = 0; n <= engine->max_n; ++n) {
    engine->apertures[n] = MakeAperture(n, engine->fall_off, weights);
    engine->view_counts[n] = CountViews(n);
    weights += ApertureSize(n);
  }
  for (int32_t n = 0; n <= engine->max_subaperture_n; ++n) {
    engine->subapertures[n] = MakeSubapertures(n, engine->fall_off, weights);
    engine->subaperture_view_counts[n] = CountSubapertures(engine->subapertures[n]);
    weights += ApertureSize(n);
  }
  engine->blur_steps = 0;
}

void SetViews(const Plane<const uint8_t>* views, EngineState* engine) {
  const sf_config& config = engine->config;
  for (int layer = 0; layer < SF_LAYERS; ++layer) {
    Window& window = engine->windows[layer];
    window.layer = layer;
    window.width = LayerSize(config.width, layer);
    window.height = LayerSize(config.height, layer);
    window.picture_width = config.width;
    window.picture_height = config.height;
    window.views = config.views;
    for (int view = 0; view < config.views; ++view) window.view[view] = views[view];
    window.disparity = {engine->disparity.data, engine->disparity.stride, engine->disparity.rows,
                        0};
    engine->layers[layer].width = window.width;
    engine->layers[layer].height = window.height;
  }
  engine->windows[0].centre = views[0];
}

sf_status ConvertDisparity(const EngineState& engine, const float* row, int16_t* out) {
  const sf_config& config = engine.config;
  const auto width = static_cast<size_t>(config.width);
  if (!engine.kernels->ConvertDisparity(row, width, config.disparity_min, config.disparity_max,
                                        out)) {
    for (size_t x = 0; x < width; ++x) {
      if (!(row[x] - row[x] == 0.0f)) return SF_ERROR_NOT_FINITE;
    }
    return SF_ERROR_DISPARITY;
  }
  CheckAll(ranges::kDisparity, out, width);
  return SF_OK;
}

sf_status ReadDisparity(const float* row, int32_t y, EngineState* engine) {
  engine->report.disparity_bytes += sizeof(float) * static_cast<uint64_t>(engine->config.width);
  return ConvertDisparity(*engine, row, engine->disparity.Row(y));
}

void TakeCounts(EngineState* engine) {
  sf_report& report = engine->report;
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    const Counts& counts = engine->workers[worker].counts;
    for (int layer = 0; layer < SF_LAYERS; ++layer) {
      const sf_layer_report& part = counts.layers[layer];
      sf_layer_report& sum = report.layers[layer];
      sum.blocks += part.blocks;
      sum.pixels += part.pixels;
      sum.views += part.views;
      sum.rendered_samples += part.rendered_samples;
      sum.predicted_ps += part.predicted_ps;
      sum.measured_ns += part.measured_ns;
      report.rendered_samples += part.rendered_samples;
    }
    report.skipped.copied_blocks += counts.skipped.copied_blocks;
    report.skipped.copied_pixels += counts.skipped.copied_pixels;
    report.skipped.filled_blocks += counts.skipped.filled_blocks;
    report.skipped.filled_pixels += counts.skipped.filled_pixels;
    report.centre_bytes += counts.centre_bytes;
    report.side_bytes += counts.side_bytes;
    report.gathered_pixels += counts.gathered_pixels;
  }
  DropCounts(engine);
}

void DropCounts(EngineState* engine) {
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    engine->workers[worker].counts = Counts();
  }
}

void ForgetStripe(EngineState* engine) {
  LayerMap& map = engine->map;
  std::memset(map.units, kNoLayer, static_cast<size_t>(map.columns));
  engine->plan.all_measured = false;
}

}  // namespace starfocus
