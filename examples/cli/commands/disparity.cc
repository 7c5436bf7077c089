// SPDX-License-Identifier: Apache-2.0
// starfocus disparity: a disparity map from captured views.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
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
  std::string folder, out, confidence, coverage;
  std::optional<DisparityRange> range;
  Positions views;
  int threads = 1;
  bool repair = false;
};

struct Plan {
  std::string map, picture;
  DisparityRange range;
};

// MIN:MAX.
std::string ReadRange(const std::string& text, std::optional<DisparityRange>* range) {
  const std::vector<double> ends = ReadNumbers(text, ':');
  if (ends.size() != 2 || ends[0] < -STARFOCUS_MAX_DISPARITY || ends[0] > ends[1] ||
      ends[1] > STARFOCUS_MAX_DISPARITY) {
    return "MIN:MAX, disparities within +-" + Short(STARFOCUS_MAX_DISPARITY);
  }
  *range = {static_cast<float>(ends[0]), static_cast<float>(ends[1])};
  return "";
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
  if (options.repair && options.range) {
    return Error::Usage("--repair", "no --range: the map has one", "both");
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
  if (!options.views.empty() && StarWithin(options.views) == 1 && !options.repair) {
    return Error::Usage("--views", "17, 9 or 5: other views show no disparity here",
                        std::to_string(options.views.size()));
  }
  if (options.range) plan->range = *options.range;
  return PlanOutputs(options, plan);
}

// Estimates the map of a folder; says what was looked for.
Result<DisparityEstimate> EstimateFolder(const DisparityOptions& options, Plan* plan,
                                         const LightField& light_field) {
  if (Error error = CheckStar(options.folder, light_field)) return error;
  if (!options.range) {
    const Result<DisparityRange> range = FindRange(options.folder, light_field, options.threads);
    if (!range) return range.error();
    plan->range = *range;
  }
  return EstimateDisparity(options.folder, light_field, plan->range, options.threads);
}

// Repairs the map of a folder.
Result<DisparityEstimate> RepairFolder(const DisparityOptions& options, Plan* plan,
                                       LightField* light_field) {
  DisparityEstimate estimate;
  Image* confidence = options.confidence.empty() ? nullptr : &estimate.confidence;
  if (Error error = RepairDisparity(DisparityPath(options.folder), options.threads,
                                    !options.coverage.empty(), light_field, confidence))
    return error;
  if (!options.coverage.empty() && light_field->coverage.empty()) {
    std::fprintf(stderr, "%s: no coverage to write: %s\n", options.folder.c_str(),
                 light_field->views.size() > 1 ? "only a repair with one view (--views 1) finds it"
                                               : "found no hair with a closed outline");
  } else if (!options.coverage.empty()) {
    estimate.coverage = DrawLevels(light_field->coverage, light_field->views[0]);
  }
  estimate.map = std::move(light_field->disparity);
  const auto ends = std::minmax_element(estimate.map.values.begin(), estimate.map.values.end());
  plan->range = {*ends.first, *ends.second};
  return estimate;
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
  if (Error error = MakePlan(options, &plan)) return error;
  ThreadRunner runner(options.threads);
  Result<LightField> loaded = options.repair
                                  ? LoadLightField(options.folder, options.views, &runner)
                                  : LoadCaptured(options.folder, options.views, &runner);
  if (!loaded) return loaded.error();
  LightField& light_field = *loaded;
  const double start = Seconds();
  const Result<DisparityEstimate> estimate = options.repair
                                                 ? RepairFolder(options, &plan, &light_field)
                                                 : EstimateFolder(options, &plan, light_field);
  if (!estimate) return estimate.error();
  const double seconds = Seconds() - start;
  if (Error error = WriteMap(options, plan, *estimate)) return error;
  const double megapixels = 1e-6 * estimate->map.width * estimate->map.height;
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
           Target([range = &options->range](const std::string& text) {
             return ReadRange(text, range);
           })},
          {"--views", "17|9|5|1|U,V:U,V",
           "17, 9 or 5, 1 as well of a repair; default: all of the folder", Views(&options->views)},
          {"--threads", "N", "1 to 64", Threads(&options->threads), Use::kDefault},
      },
      [options] { return Run(*options); }};
}

}  // namespace starfocus
