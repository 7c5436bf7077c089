// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/refocus_report.h"

namespace starfocus {
namespace {

double Share(uint64_t part, uint64_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

// Shares are of all layers together; seconds are those of the processor, summed over the threads.
// The timing model is one of blocks that are refocused by views after an analysis of their content.
nlohmann::ordered_json LayersJson(const sf_report& report, bool predicted) {
  uint64_t pixels = 0, time = 0;
  for (const sf_layer_report& layer : report.layers) {
    pixels += layer.pixels;
    time += layer.measured_ns;
  }
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (int l = 0; l < SF_LAYERS; ++l) {
    const sf_layer_report& layer = report.layers[l];
    nlohmann::ordered_json json;
    json["layer"] = l;
    json["blocks"] = layer.blocks;
    json["area_share"] = Share(layer.pixels, pixels);
    json["time_share"] = Share(layer.measured_ns, time);
    json["views"] = layer.views;
    json["rendered_samples"] = layer.rendered_samples;
    json["seconds"] = 1e-9 * static_cast<double>(layer.measured_ns);
    json["seconds_predicted"] = nullptr;
    if (predicted) json["seconds_predicted"] = 1e-12 * static_cast<double>(layer.predicted_ps);
    layers.push_back(json);
  }
  return layers;
}

// Side views are read where holes open; beside it what they have in all.
nlohmann::ordered_json SkippedJson(const EngineTask& task, const sf_report& report) {
  const sf_skipped& skipped = report.skipped;
  nlohmann::ordered_json json;
  json["copied_blocks"] = skipped.copied_blocks;
  json["copied_pixels"] = skipped.copied_pixels;
  json["filled_blocks"] = skipped.filled_blocks;
  json["filled_pixels"] = skipped.filled_pixels;
  json["layer_columns"] = skipped.layer_columns;
  json["boundaries"] = skipped.boundaries;
  json["gathered_pixels"] = report.gathered_pixels;
  json["side_bytes_read"] = report.side_bytes;
  json["side_bytes"] = uint64_t{3} * uint64_t(task.config.views - 1) * uint64_t(task.config.width) *
                       uint64_t(task.config.height);
  return json;
}

// Bytes of the pictures read and written, against each read once: a pixel of the centre view, its
// disparity if that was not prepared, and a pixel written. Side views need none where no hole
// opens.
nlohmann::ordered_json TrafficJson(const EngineTask& task, const sf_report& report) {
  const sf_region& region = task.params.region;
  const uint64_t pixels = region.width > 0
                              ? uint64_t(region.width) * uint64_t(region.height)
                              : uint64_t(task.config.width) * uint64_t(task.config.height);
  const uint64_t output = 3 * pixels;
  const uint64_t all = report.centre_bytes + report.disparity_bytes + report.side_bytes + output;
  nlohmann::ordered_json json;
  json["centre_bytes_read"] = report.centre_bytes;
  json["disparity_bytes_read"] = report.disparity_bytes;
  json["side_bytes_read"] = report.side_bytes;
  json["bytes_written"] = output;
  json["bytes_per_pixel"] = double(all) / double(pixels);
  json["least_bytes_per_pixel"] = report.disparity_bytes > 0 ? 3 + 4 + 3 : 3 + 3;
  return json;
}

// Largest blocks of the picture or region.
uint64_t LargestBlocks(const EngineTask& task, int side) {
  const sf_config& config = task.config;
  const sf_region& region = task.params.region;
  const auto count = [&](int first, int size) {
    return static_cast<uint64_t>((first + size - 1) / side - first / side + 1);
  };
  if (region.width == 0) return count(0, config.width) * count(0, config.height);
  return count(region.x, region.width) * count(region.y, region.height);
}

nlohmann::ordered_json ShapeJson(const sf_config& config) {
  constexpr const char* kNames[] = {"fall-off", "disc", "polygon", "ring"};
  nlohmann::ordered_json json;
  json["name"] = kNames[config.aperture_shape];
  if (config.aperture_shape == SF_SHAPE_FALL_OFF) json["theta"] = config.theta;
  if (config.aperture_shape == SF_SHAPE_POLYGON) {
    json["blades"] = config.blades;
    json["rotation"] = config.rotation;
    json["curvature"] = config.curvature;
  }
  if (config.aperture_shape == SF_SHAPE_RING) json["inner"] = config.ring_inner;
  json["cats_eye"] = config.cats_eye;
  return json;
}

nlohmann::ordered_json ReportJson(const EngineTask& task, const EngineResult& result) {
  nlohmann::ordered_json json;
  json["mode"] = kModeNames[task.params.mode];
  json["width"] = task.config.width;
  json["height"] = task.config.height;
  const sf_region& region = task.params.region;
  if (region.width > 0) json["region"] = {region.x, region.y, region.width, region.height};
  json["views"] = task.config.views;
  json["focus"] = task.params.focus;
  json["aperture"] = task.params.aperture;
  json["highlights"] = task.config.highlights;
  json["transfer"] = task.config.transfer == SF_TRANSFER_NONE ? "none" : "srgb";
  json["shape"] = ShapeJson(task.config);
  json["n_scale"] = task.config.n_scale;
  json["r_max"] = result.report.r_max;
  json["N"] = result.report.n;
  json["rendered_views"] = result.report.rendered_views;
  json["rendered_samples"] = result.report.rendered_samples;
  json["largest_block"] = result.report.largest_block;
  json["max_layer"] = task.config.max_layer;
  json["deblocking"] = task.config.deblocking;
  json["layers"] = LayersJson(result.report, task.params.mode == SF_MODE_BLOCK);
  json["skipped"] = SkippedJson(task, result.report);
  json["traffic"] = TrafficJson(task, result.report);
  json["seconds_refocus"] = result.seconds;
  json["workspace_bytes"] = result.workspace_bytes;
  json["simd_target"] = sf_simd_target();
  json["threads"] = task.threads;
  return json;
}

}  // namespace

std::string ReportText(const EngineTask& task, const EngineResult& result, double seconds_total) {
  nlohmann::ordered_json json = ReportJson(task, result);
  json["seconds_total"] = seconds_total;
  return json.dump(2) + "\n";
}

void SeriesReport::Add(const std::string& output, const EngineTask& task,
                       const EngineResult& result) {
  nlohmann::ordered_json json;
  json["output"] = output;
  json.update(ReportJson(task, result));
  json["prepared_bytes"] = result.prepared_bytes;
  const uint64_t blocks = LargestBlocks(task, result.report.largest_block);
  json["largest_blocks"] = blocks;
  json["reused_blocks"] = result.report.reused_blocks;
  largest_blocks_ += blocks;
  reused_blocks_ += result.report.reused_blocks;
  pictures_.push_back(json);
}

std::string SeriesReport::Text(double seconds_total) const {
  nlohmann::ordered_json json;
  json["pictures"] = pictures_;
  json["largest_blocks"] = largest_blocks_;
  json["reused_blocks"] = reused_blocks_;
  json["seconds_total"] = seconds_total;
  return json.dump(2) + "\n";
}

}  // namespace starfocus
