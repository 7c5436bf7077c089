// SPDX-License-Identifier: Apache-2.0
// starfocus disparity: a disparity map from captured views.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/disparity/estimate_run.h"
#include "examples/cli/disparity/map_figures.h"
#include "examples/command_line/options.h"
#include "examples/command_line/outputs.h"
#include "platform/clock.h"
#include "platform/image_io.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

struct DisparityOptions {
  std::string folder, out, confidence, coverage, range, views, threads = "1";
  bool repair = false;
};

struct Plan {
  std::string map, picture;
  bool has_range = false;
  DisparityRange range;
  Positions views;
  int threads = 1;
};

// MIN:MAX.
Error ParseRange(const std::string& text, DisparityRange* range) {
  const size_t colon = text.find(':');
  double low = 0, high = 0;
  const bool numbers = colon != std::string::npos &&
                       !ParseNumber("", text.substr(0, colon), &low) &&
                       !ParseNumber("", text.substr(colon + 1), &high);
  if (!numbers || !(low >= -SF_MAX_DISPARITY && low <= high && high <= SF_MAX_DISPARITY)) {
    return Error::Usage("--range", "MIN:MAX, disparities within +-" + Short(SF_MAX_DISPARITY),
                        "'" + text.substr(0, 60) + "'");
  }
  *range = {static_cast<float>(low), static_cast<float>(high)};
  return {};
}

// The pictures that were asked for.
std::vector<Output> PicturesOf(const DisparityOptions& options) {
  std::vector<Output> pictures;
  if (!options.confidence.empty()) pictures.push_back({"--confidence", options.confidence});
  if (!options.coverage.empty()) pictures.push_back({"--coverage", options.coverage});
  return pictures;
}

Error PlanOutputs(const DisparityOptions& options, Plan* plan) {
  plan->map = options.out.empty() ? DisparityPath(options.folder) : options.out;
  if (std::filesystem::path(plan->map).extension() != ".pfm") {
    return Error::Usage("--output", "a name that ends in .pfm", plan->map);
  }
  plan->picture = std::filesystem::path(plan->map).replace_extension(".png").string();
  if (options.repair && options.out.empty()) {
    return Error::Usage("--repair", "another map to write, by --output", "none");
  }
  if (options.repair && !options.range.empty()) {
    return Error::Usage("--repair", "no --range: the map has one", options.range.substr(0, 60));
  }
  if (!options.repair && !options.coverage.empty()) {
    return Error::Usage("--coverage", "--repair, which finds coverage", "none");
  }
  if (options.out.empty() && HasDisparity(options.folder)) {
    return Expected(plan->map, "no map yet, or another name by --output", "one");
  }
  std::vector<Output> outputs = {{"--output", plan->picture}};
  if (!options.out.empty()) outputs.push_back({"--output", plan->map});
  for (const Output& picture : PicturesOf(options)) outputs.push_back(picture);
  Error error = CheckOutputPath(plan->map);
  if (!error) error = CheckImageOutput(plan->picture);
  for (const Output& picture : PicturesOf(options)) {
    if (!error) error = CheckImageOutput(picture.path);
  }
  return !error ? CheckApart(outputs, {{options.folder}, {}}) : error;
}

Error MakePlan(const DisparityOptions& options, Plan* plan) {
  Error error = ParseWhole("--threads", options.threads, 1, SF_MAX_WORKERS, &plan->threads);
  if (!error && !options.views.empty()) {
    error = ParseViews("--views", options.views, &plan->views);
    if (!error && StarWithin(plan->views) == 1 && !options.repair) {
      error =
          Error::Usage("--views", "17, 9 or 5: other views show no disparity here", options.views);
    }
  }
  plan->has_range = !options.range.empty();
  if (!error && plan->has_range) error = ParseRange(options.range, &plan->range);
  return error ? error : PlanOutputs(options, plan);
}

// Estimates the map of a folder; says what was looked for.
Error EstimateFolder(const DisparityOptions& options, Plan* plan, const LightField& light_field,
                     DisparityEstimate* estimate) {
  Error error = CheckStar(options.folder, light_field);
  if (!error && !plan->has_range) {
    error = FindRange(options.folder, light_field, plan->threads, &plan->range);
  }
  if (error) return error;
  return EstimateDisparity(options.folder, light_field, plan->range, plan->threads, estimate);
}

// Repairs the map of a folder.
Error RepairFolder(const DisparityOptions& options, Plan* plan, LightField* light_field,
                   DisparityEstimate* estimate) {
  Image* confidence = options.confidence.empty() ? nullptr : &estimate->confidence;
  if (Error error = RepairDisparity(DisparityPath(options.folder), plan->threads,
                                    !options.coverage.empty(), light_field, confidence))
    return error;
  if (!options.coverage.empty() && light_field->coverage.empty()) {
    std::fprintf(stderr, "%s: no coverage to write: %s\n", options.folder.c_str(),
                 light_field->views.size() > 1 ? "only a repair with one view (--views 1) finds it"
                                               : "found no hair with a closed outline");
  } else if (!options.coverage.empty()) {
    estimate->coverage = DrawLevels(light_field->coverage, light_field->views[0]);
  }
  estimate->map = std::move(light_field->disparity);
  const auto ends = std::minmax_element(estimate->map.values.begin(), estimate->map.values.end());
  plan->range = {*ends.first, *ends.second};
  return {};
}

Error WriteMap(const DisparityOptions& options, const Plan& plan,
               const DisparityEstimate& estimate) {
  Error error = WriteImage(plan.picture, DrawDisparity(estimate.map));
  if (!error && !options.confidence.empty()) {
    error = WriteImage(options.confidence, estimate.confidence);
  }
  if (!error && estimate.coverage.width != 0) {
    error = WriteImage(options.coverage, estimate.coverage);
  }
  return error ? error : WritePfm(plan.map, estimate.map);
}

Error Run(const DisparityOptions& options) {
  Plan plan;
  LightField light_field;
  if (Error error = MakePlan(options, &plan)) return error;
  ThreadRunner runner(plan.threads);
  if (Error error = options.repair
                        ? LoadLightField(options.folder, plan.views, &light_field, &runner)
                        : LoadCaptured(options.folder, plan.views, &light_field, &runner))
    return error;
  const double start = Seconds();
  DisparityEstimate estimate;
  Error error = options.repair ? RepairFolder(options, &plan, &light_field, &estimate)
                               : EstimateFolder(options, &plan, light_field, &estimate);
  const double seconds = Seconds() - start;
  if (!error) error = WriteMap(options, plan, estimate);
  if (error) return error;
  const double megapixels = 1e-6 * estimate.map.width * estimate.map.height;
  const int count = StarWithin(light_field.positions);
  std::printf("%s: %s to %s %s %d view%s, %.1f s, %.1f s per megapixel\n", plan.map.c_str(),
              Short(plan.range.min).c_str(), Short(plan.range.max).c_str(),
              options.repair ? "repaired by" : "looked for in", count, count == 1 ? "" : "s",
              seconds, seconds / megapixels);
  return {};
}

}  // namespace

Command DisparityCommand() {
  const auto options = std::make_shared<DisparityOptions>();
  return {
      "disparity",
      "Estimate the disparity map of a light field from its views, or repair its map",
      {
          {"DIR", "DIR", "Light-field folder", &options->folder, Use::kRequired},
          {"-o,--output", "FILE",
           "Map to write (.pfm). A picture of the map (.png, near is bright) is written beside "
           "it; default: disparity.pfm in DIR, if there is none",
           &options->out},
          {"--confidence", "FILE",
           "Picture to write: how sure each pixel is, black where not at all",
           &options->confidence},
          {"--coverage", "FILE",
           "With --repair and one view: picture to write of the coverage of hair whose outline the "
           "map has closed. Put it beside the written map as coverage.png",
           &options->coverage},
          {"--repair", nullptr,
           "Repair the folder's map by the views instead: displaced and blurred edges, and "
           "noise; needs --output",
           &options->repair},
          {"--range", "MIN:MAX",
           "MIN:MAX, the disparities to look for; default: those found in small "
           "pictures, up to an eighth of the width",
           &options->range},
          {"--views", "17|9|5|1|U,V:U,V",
           "17, 9 or 5, 1 as well of a repair; default: all of the folder", &options->views},
          {"--threads", "N", "1 to 64", &options->threads, Use::kDefault},
      },
      [options] { return Run(*options); }};
}

}  // namespace starfocus
