// SPDX-License-Identifier: Apache-2.0
// starfocus disparity: estimates or repairs a disparity map.
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

// Output files.
struct Plan {
  std::string map, picture;
};

// Parses MIN:MAX.
std::string ReadRange(const std::string& text, std::optional<DisparityRange>* range) {
  const std::vector<double> ends = ReadNumbers(text, ':');
  if (ends.size() != 2 || ends[0] < -STARFOCUS_MAX_DISPARITY || ends[0] > ends[1] ||
      ends[1] > STARFOCUS_MAX_DISPARITY) {
    return "MIN:MAX with disparities from -" + Short(STARFOCUS_MAX_DISPARITY) + " to " +
           Short(STARFOCUS_MAX_DISPARITY);
  }
  *range = {static_cast<float>(ends[0]), static_cast<float>(ends[1])};
  return "";
}

// Checks all options that can be checked before a file is read.
Result<Plan> MakePlan(const DisparityOptions& options) {
  if (!options.views.empty() && StarWithin(options.views) == 1 && !options.repair) {
    return Error::Usage("--views", "a star of 17, 9 or 5 views",
                        std::to_string(options.views.size()) +
                            (options.views.size() == 1 ? " view" : " views that form no star"));
  }
  Plan plan = {options.out.empty() ? DisparityPath(options.folder) : options.out, ""};
  if (std::filesystem::path(plan.map).extension() != ".pfm") {
    return Error::Usage("--output", "a name that ends in .pfm", plan.map);
  }
  plan.picture = std::filesystem::path(plan.map).replace_extension(".png").string();
  if (options.repair && options.out.empty()) {
    return Error::Usage("--repair", "the name of the repaired map by --output", "none");
  }
  if (options.repair && options.range) {
    return Error::Usage("--repair", "no --range, because the map defines the range", "both");
  }
  if (!options.repair && !options.coverage.empty()) {
    return Error::Usage("--coverage", "--repair as well, because only a repair finds coverage",
                        "no --repair");
  }
  if (options.out.empty() && HasDisparity(options.folder)) {
    return Expected(plan.map, "no existing map, or another name by --output", "an existing map");
  }
  std::vector<Output> outputs = {{"--output", plan.picture}};
  if (!options.confidence.empty()) outputs.push_back({"--confidence", options.confidence});
  if (!options.coverage.empty()) outputs.push_back({"--coverage", options.coverage});
  Error error = CheckOutputPath(plan.map);
  for (const Output& picture : outputs) {
    if (!error) error = CheckImageOutput(picture.path);
  }
  if (!options.out.empty()) outputs.insert(outputs.begin(), {"--output", plan.map});
  if (!error) error = CheckApart(outputs, {{options.folder}, {}});
  if (error) return error;
  return plan;
}

// Estimates the map of a light-field folder. Searches the disparity range of the command line if
// given, otherwise finds a range first.
Result<DisparityEstimate> EstimateFolder(const DisparityOptions& options,
                                         const LightField& light_field) {
  if (Error error = CheckStar(options.folder, light_field)) return error;
  const Result<DisparityRange> range =
      options.range ? *options.range : FindRange(options.folder, light_field, options.threads);
  if (!range) return range.error();
  return EstimateDisparity(options.folder, light_field, *range, options.threads);
}

// Repairs the map of a light-field folder.
Result<DisparityEstimate> RepairFolder(const DisparityOptions& options,
                                       const LightField& light_field) {
  Result<DisparityEstimate> estimate =
      RepairDisparity(DisparityPath(options.folder), light_field,
                      {options.threads, !options.coverage.empty(), !options.confidence.empty()});
  if (estimate && !options.coverage.empty() && estimate->coverage.empty()) {
    std::fprintf(stderr, "%s: no coverage is written: %s\n", options.folder.c_str(),
                 light_field.views.size() > 1
                     ? "only a repair with one view (--views 1) finds coverage"
                     : "the map has no hair with a closed outline");
  }
  return estimate;
}

Error WriteMap(const DisparityOptions& options, const Plan& plan, const Image& centre,
               const DisparityEstimate& estimate) {
  Error error = WriteImage(plan.picture, DrawDisparity(estimate.map));
  if (!error && !options.confidence.empty()) {
    error = WriteImage(options.confidence, estimate.confidence);
  }
  if (!error && !estimate.coverage.empty()) {
    error = WriteImage(options.coverage, DrawLevels(estimate.coverage, centre));
  }
  return error ? error : WritePfm(plan.map, estimate.map);
}

Error Run(const DisparityOptions& options) {
  const Result<Plan> plan = MakePlan(options);
  if (!plan) return plan.error();
  ThreadRunner runner(options.threads);
  const Result<LightField> loaded = options.repair
                                        ? LoadLightField(options.folder, options.views, &runner)
                                        : LoadCaptured(options.folder, options.views, &runner);
  if (!loaded) return loaded.error();
  const LightField& light_field = *loaded;
  const double start = Seconds();
  const Result<DisparityEstimate> estimate =
      options.repair ? RepairFolder(options, light_field) : EstimateFolder(options, light_field);
  if (!estimate) return estimate.error();
  const double seconds = Seconds() - start;
  if (Error error = WriteMap(options, *plan, light_field.views[0], *estimate)) return error;
  const double megapixels = 1e-6 * estimate->map.width * estimate->map.height;
  const int count = StarWithin(light_field.positions);
  std::printf("%s: disparities from %s to %s, %s %d view%s, %.1f s, %.1f s per megapixel\n",
              plan->map.c_str(), Short(estimate->range.min).c_str(),
              Short(estimate->range.max).c_str(),
              options.repair ? "repaired with" : "estimated from", count, count == 1 ? "" : "s",
              seconds, seconds / megapixels);
  return {};
}

}  // namespace

Command DisparityCommand() {
  const auto options = std::make_shared<DisparityOptions>();
  return {
      "disparity",
      "Estimate the disparity map of a light field from its views, or repair an existing map",
      {
          {"DIR", "DIR", "Light-field folder", &options->folder, Use::kRequired},
          {"-o,--output", "FILE",
           "Map to write (.pfm); a picture of the map (.png, bright is near) gets the "
           "same name; default: disparity.pfm in DIR, if DIR has none",
           &options->out},
          {"--confidence", "FILE",
           "Picture to write of the confidence of each pixel: black for unknown, brighter "
           "for more certain; default: none",
           &options->confidence},
          {"--coverage", "FILE",
           "With --repair and one view, picture to write of the coverage of hair with a "
           "closed outline in the map; default: none",
           &options->coverage},
          {"--repair", nullptr,
           "Repair the map of the folder by the views instead of estimating a new one: "
           "displaced and blurred edges, and noise; needs --output",
           &options->repair},
          {"--range", "MIN:MAX",
           "Disparities to search, in pixels per unit of u, from -500 to 500; default: "
           "the range found in reduced views, at most an eighth of the width",
           Target([range = &options->range](const std::string& text) {
             return ReadRange(text, range);
           })},
          {"--views", "17|9|5|1|U,V:U,V",
           "Views to use: the star of 17, 9 or 5 views; with --repair also 1 or positions "
           "U,V:U,V; default: all views of the folder",
           Views(&options->views)},
          {"--threads", "N", "Number of threads, 1 to 64", Threads(&options->threads),
           Use::kDefault},
      },
      [options] { return Run(*options); },
      {"starfocus disparity lf", "starfocus disparity lf -o repaired.pfm --repair --threads 4"}};
}

}  // namespace starfocus
