// SPDX-License-Identifier: Apache-2.0
// starfocus info: what a light-field folder holds.
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/disparity/estimate_run.h"
#include "examples/command_line/options.h"
#include "platform/light_field.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

constexpr int kBins = 16;
constexpr int kBarLength = 50;

struct Options {
  std::string folder;
  bool json = false;
};

std::vector<int64_t> Histogram(const FloatMap& map, const sf_disparity_stats& stats) {
  std::vector<int64_t> counts(kBins);
  const double range = double(stats.max) - stats.min;
  for (float d : map.values) {
    if (!std::isfinite(d)) continue;
    const double place = range > 0 ? (double(d) - stats.min) / range * kBins : 0;
    const int bin = static_cast<int>(place);
    ++counts[size_t(bin < kBins ? bin : kBins - 1)];
  }
  return counts;
}

double BinEdge(const sf_disparity_stats& stats, int bin) {
  return stats.min + (double(stats.max) - stats.min) * bin / kBins;
}

void PrintText(const std::string& folder, const LightField& light_field,
               const sf_disparity_stats& stats, const std::vector<int64_t>& counts) {
  std::printf("%s: %dx%d, %zu views\n", folder.c_str(), light_field.width(), light_field.height(),
              light_field.views.size());
  if (!AreStar(light_field.positions)) {
    std::printf("at");
    for (const sf_position& at : light_field.positions) std::printf(" (%g, %g)", at.u, at.v);
    std::printf("\n");
  }
  std::printf("disparity %g to %g pixels per unit u, %lld invalid\n", stats.min, stats.max,
              static_cast<long long>(stats.invalid));
  int64_t most = 1;
  for (int64_t count : counts) most = count > most ? count : most;
  for (int bin = kBins - 1; bin >= 0; --bin) {
    const int64_t count = counts[size_t(bin)];
    const int length = static_cast<int>((count * kBarLength + most - 1) / most);
    std::printf("%9.3f to %9.3f %9lld %s\n", BinEdge(stats, bin), BinEdge(stats, bin + 1),
                static_cast<long long>(count), std::string(size_t(length), '#').c_str());
  }
}

void PrintJson(const LightField& light_field, const sf_disparity_stats& stats,
               const std::vector<int64_t>& counts) {
  nlohmann::ordered_json json;
  json["width"] = light_field.width();
  json["height"] = light_field.height();
  json["views"] = light_field.views.size();
  for (const sf_position& at : light_field.positions) json["positions"].push_back({at.u, at.v});
  json["disparity_min"] = stats.min;
  json["disparity_max"] = stats.max;
  json["invalid"] = stats.invalid;
  json["histogram"] = counts;
  std::printf("%s\n", json.dump().c_str());
}

Error Run(const Options& options) {
  LightField light_field;
  const Error error = LoadOrEstimate(options.folder, {}, 1, &light_field);
  if (!error.empty()) return error;
  const FloatMap& map = light_field.disparity;
  sf_disparity_stats stats = {};
  const sf_status status = sf_measure_disparity(
      map.values.data(), sizeof(float) * size_t(map.width), map.width, map.height, &stats);
  if (status != SF_OK) {
    return Expected(DisparityPath(options.folder), "disparities that can be measured",
                    sf_status_string(status));
  }
  const std::vector<int64_t> counts = Histogram(map, stats);
  if (options.json) {
    PrintJson(light_field, stats, counts);
  } else {
    PrintText(options.folder, light_field, stats, counts);
  }
  return "";
}

}  // namespace

void AddInfoCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "info", "Size, views, disparity range and histogram of a light-field folder");
  command->add_option("DIR", options->folder, "Light-field folder")->type_name("DIR")->required();
  command->add_flag("--json", options->json, "Print JSON; histogram bins go from min to max");
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
