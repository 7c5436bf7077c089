// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/bench/output.h"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "platform/light_field.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "starfocus/version.h"

namespace starfocus::bench {
namespace {

// Returns the name of the processor from /proc/cpuinfo, or "unknown".
std::string CpuName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.rfind("model name", 0) == 0 || line.rfind("Model", 0) == 0) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

}  // namespace

Machine ThisMachine(const std::string& revision) {
  Machine machine;
  machine.cpu = CpuName();
  machine.target = starfocus_simd_target();
#if defined(__clang__)
  machine.compiler = "clang " __clang_version__;
#else
  machine.compiler = "gcc " __VERSION__;
#endif
  machine.version = STARFOCUS_VERSION_STRING;
  if (!revision.empty()) machine.version += " " + revision;
  return machine;
}

namespace {

using Json = nlohmann::ordered_json;

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void AddQuality(const char* against, const Quality& quality, Json* json) {
  const std::string suffix = std::string("_") + against;
  (*json)["psnr" + suffix] = Number(quality.psnr);
  (*json)["ssim" + suffix] = Number(quality.ssim);
  (*json)["worst_block_psnr" + suffix] = Number(quality.worst);
  (*json)["edge_band_psnr" + suffix] = Number(quality.band);
}

// Returns the values of a row as texts, in the order of the columns.
Json Describe(const Machine& machine, const Row& row) {
  Json json;
  json["study"] = row.study;
  json["field"] = row.field;
  json["width"] = row.width;
  json["height"] = row.height;
  json["mode"] = row.task.mode;
  json["views"] = row.task.views;
  json["max_layer"] = row.task.max_layer;
  json["superblock"] = row.superblock;
  json["superblock_option"] = row.task.superblock;
  json["renderer"] = row.task.renderer == STARFOCUS_RENDERER_AUTO        ? "auto"
                     : row.task.renderer == STARFOCUS_RENDERER_LINE_SCAN ? "line-scan"
                                                                         : "slices";
  json["n_scale"] = row.task.n_scale;
  json["workers"] = row.task.workers;
  json["aperture"] = row.aperture;
  json["focus"] = row.focus;
  json["quantile"] = Number(row.quantile);
  json["r_max"] = Number(row.r_max);
  json["N"] = row.n;
  json["rendered_views"] = row.rendered_views;
  json["rendered_samples"] = row.rendered_samples;
  AddQuality("benchmark", row.benchmark, &json);
  AddQuality("truth", row.truth, &json);
  json["ms"] = row.ms;
  json["wall_ms"] = Number(row.wall_ms);
  json["least_wall_ms"] = Number(row.least_wall_ms);
  json["spread"] = row.spread;
  json["runs"] = row.runs;
  json["ns_per_pixel"] = row.ns_per_pixel();
  json["msamples_per_s"] = row.msamples_per_s();
  json["speed_to_frame"] = Number(row.ratio_frame);
  json["speed_to_blur"] = Number(row.ratio_blur);
  json["workspace_bytes"] = row.workspace;
  for (int i = 0; i < STARFOCUS_LAYERS; ++i) {
    json["time_share_layer_" + std::to_string(i)] = row.layer_time[i];
    json["pixel_share_layer_" + std::to_string(i)] = row.layer_pixels[i];
  }
  json["simd_target"] = row.task.target.empty() ? machine.target : row.task.target;
  json["cpu"] = machine.cpu;
  json["compiler"] = machine.compiler;
  json["version"] = machine.version;
  return json;
}

}  // namespace

std::string ToCsv(const Machine& machine, const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    const Json json = Describe(machine, row);
    std::string head, line;
    for (const auto& item : json.items()) {
      head += (head.empty() ? "" : ",") + item.key();
      // Strings may contain commas, but no quotation marks.
      line += (line.empty() ? "" : ",") + (item.value().is_null() ? "" : item.value().dump());
    }
    if (text.empty()) text = head + "\n";
    text += line + "\n";
  }
  return text;
}

std::string ToJson(const Machine& machine, const std::vector<Row>& rows) {
  Json all = Json::array();
  for (const Row& row : rows) all.push_back(Describe(machine, row));
  return all.dump(1) + "\n";
}

}  // namespace starfocus::bench
