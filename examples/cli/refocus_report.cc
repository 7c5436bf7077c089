// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus_report.h"

#include <utility>

#include "starfocus/starfocus.hpp"

namespace starfocus {

namespace {

double Share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Returns the statistics of each layer as JSON. The shares of area and time are fractions of the
// totals over all layers. Times in seconds are CPU times, summed over the threads. The timing model
// applies only to blocks that are rendered with views after an analysis of the block's content.
Json LayersJson(const EngineResult& result, bool predicted) {
  uint64_t pixels = 0, time = 0;
  for (const starfocus_layer_report& layer : result.layers) {
    pixels += layer.pixels;
    time += layer.measured_ns;
  }
  Json layers = Json::Array();
  for (int l = 0; l < STARFOCUS_LAYERS; ++l) {
    const starfocus_layer_report& layer = result.layers[l];
    Json json;
    json.Set("layer", l);
    json.Set("blocks", layer.blocks);
    json.Set("area_share", Share(layer.pixels, pixels));
    json.Set("time_share", Share(layer.measured_ns, time));
    json.Set("views", layer.views);
    json.Set("rendered_samples", layer.rendered_samples);
    json.Set("seconds", 1e-9 * static_cast<double>(layer.measured_ns));
    json.Set("seconds_predicted", nullptr);
    if (predicted) json.Set("seconds_predicted", 1e-12 * static_cast<double>(layer.predicted_ps));
    layers.Add(std::move(json));
  }
  return layers;
}

// Returns the number of superblocks of the picture or region.
uint64_t Superblocks(const EngineTask& task, int side) {
  const starfocus::Config& config = task.config;
  const starfocus_region& region = task.params.region;
  const auto count = [&](int first, int size) {
    return static_cast<uint64_t>((first + size - 1) / side - first / side + 1);
  };
  if (region.width == 0) return count(0, config.width) * count(0, config.height);
  return count(region.x, region.width) * count(region.y, region.height);
}

Json ShapeJson(const starfocus::Params& lens) {
  constexpr const char* kNames[] = {"fall-off", "disc", "polygon", "ring"};
  Json json;
  json.Set("name", kNames[lens.shape]);
  if (lens.shape == STARFOCUS_SHAPE_FALL_OFF) json.Set("theta", lens.theta);
  if (lens.shape == STARFOCUS_SHAPE_POLYGON) {
    json.Set("blades", lens.blades);
    json.Set("rotation", lens.rotation);
    json.Set("curvature", lens.curvature);
  }
  if (lens.shape == STARFOCUS_SHAPE_RING) json.Set("inner", lens.ring_inner);
  json.Set("cats_eye", lens.cats_eye);
  return json;
}

void AddFigures(const EngineTask& task, const EngineResult& result, Json* json) {
  json->Set("mode", kModeNames[task.params.study.mode]);
  json->Set("width", task.config.width);
  json->Set("height", task.config.height);
  const starfocus_region& region = task.params.region;
  if (region.width > 0) {
    json->Set("region", Json::Array({region.x, region.y, region.width, region.height}));
  }
  json->Set("views", task.config.views);
  const starfocus::Params& lens = task.params;
  json->Set("focus", lens.focus);
  if (lens.focus_nearer > 0 || lens.focus_farther > 0) {
    json->Set("focus_range",
              Json::Array({lens.focus + lens.focus_nearer, lens.focus - lens.focus_farther}));
  }
  json->Set("aperture", lens.aperture);
  json->Set("highlights", task.config.highlights);
  json->Set("transfer", task.config.transfer == STARFOCUS_TRANSFER_NONE ? "none" : "srgb");
  json->Set("shape", ShapeJson(lens));
  json->Set("n_scale", task.config.tuning.n_scale);
  json->Set("r_max", result.report.r_max);
  json->Set("N", result.report.n);
  json->Set("rendered_views", result.report.rendered_views);
  json->Set("rendered_samples", result.report.rendered_samples);
  json->Set("superblock", result.report.superblock);
  json->Set("max_layer", task.config.tuning.max_layer);
  json->Set("deblocking", task.config.tuning.deblocking);
  json->Set("layers", LayersJson(result, task.params.study.mode == STARFOCUS_MODE_BLOCK));
  json->Set("copied_pixels", result.report.copied_pixels);
  json->Set("gathered_pixels", result.report.gathered_pixels);
  json->Set("seconds_refocus", result.seconds);
  json->Set("workspace_bytes", result.workspace_bytes);
  json->Set("simd_target", starfocus_simd_target());
  json->Set("threads", task.threads);
}

}  // namespace

std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total) {
  Json json;
  AddFigures(task, result, &json);
  json.Set("seconds_total", seconds_total);
  return json.Text(2) + "\n";
}

void SeriesReport::Add(const std::string& output, const EngineTask& task,
                       const EngineResult& result) {
  Json json;
  json.Set("output", output);
  AddFigures(task, result, &json);
  json.Set("prepared_bytes", result.prepared_bytes);
  const uint64_t blocks = Superblocks(task, result.report.superblock);
  json.Set("superblocks", blocks);
  json.Set("reused_blocks", result.report.reused_blocks);
  superblocks_ += blocks;
  reused_blocks_ += result.report.reused_blocks;
  pictures_.Add(std::move(json));
}

std::string SeriesReport::Text(double seconds_total) const {
  Json json;
  json.Set("pictures", pictures_);
  json.Set("superblocks", superblocks_);
  json.Set("reused_blocks", reused_blocks_);
  json.Set("seconds_total", seconds_total);
  return json.Text(2) + "\n";
}

}  // namespace starfocus
