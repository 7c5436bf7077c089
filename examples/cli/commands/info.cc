// SPDX-License-Identifier: Apache-2.0
// starfocus info: what a light field or depth photo holds, and what was understood of it.
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/input/input.h"
#include "examples/command_line/options.h"
#include "platform/light_field.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

constexpr int kBins = 16;
constexpr int kBarLength = 50;

struct Options {
  InputOptions input;
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

void PrintText(const Capture& capture, const sf_disparity_stats& stats,
               const std::vector<int64_t>& counts) {
  const LightField& light_field = capture.light_field;
  std::printf("%s: %dx%d, %zu views\n", capture.path.c_str(), light_field.width(),
              light_field.height(), light_field.views.size());
  std::printf("%s\n", capture.format.c_str());
  for (const auto& fact : capture.facts) {
    std::printf("  %s: %s\n", fact.first.c_str(), fact.second.c_str());
  }
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

void PrintJson(const Capture& capture, const sf_disparity_stats& stats,
               const std::vector<int64_t>& counts) {
  const LightField& light_field = capture.light_field;
  nlohmann::ordered_json json;
  json["format"] = capture.format;
  for (const auto& fact : capture.facts) json["facts"][fact.first] = fact.second;
  if (capture.widest > 0) json["widest_f_stop"] = capture.widest;
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
  Capture capture;
  Error error = OpenInput(options.input, &capture);
  if (error.empty()) error = LoadInput({}, 1, &capture);
  if (!error.empty()) return error;
  const FloatMap& map = capture.light_field.disparity;
  sf_disparity_stats stats = {};
  const sf_status status = sf_measure_disparity(
      map.values.data(), sizeof(float) * size_t(map.width), map.width, map.height, &stats);
  if (status != SF_OK) {
    return Expected(MapName(capture), "disparities that can be measured", sf_status_string(status));
  }
  const std::vector<int64_t> counts = Histogram(map, stats);
  if (options.json) {
    PrintJson(capture, stats, counts);
  } else {
    PrintText(capture, stats, counts);
  }
  return "";
}

}  // namespace

void AddInfoCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app->add_subcommand(
      "info", "What a light field or depth photo is: format, size, views, disparity range");
  AddInputOptions(command, &options->input);
  command->add_flag("--json", options->json, "Print JSON; histogram bins go from min to max");
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
