// SPDX-License-Identifier: Apache-2.0
// starfocus disparity: estimates or repairs a disparity map.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

struct DisparityOptions {
  InputOptions input;
  std::string out, confidence, coverage;
  std::optional<DisparityRange> range;
  Positions views;
  int threads = 1;
  bool repair = false;
};

// Output files.
struct Plan {
  std::string map;
  std::string picture;  // empty: no picture, because a file of this name exists
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

// Returns the name of the picture of a map.
std::string PictureOf(const std::string& map) {
  return std::filesystem::path(map).replace_extension(".png").string();
}

std::vector<OutputPath> PicturesOf(const DisparityOptions& options, const Plan& plan) {
  std::vector<OutputPath> pictures;
  if (!plan.picture.empty()) pictures.push_back({"--output", plan.picture});
  if (!options.confidence.empty()) pictures.push_back({"--confidence", options.confidence});
  if (!options.coverage.empty()) pictures.push_back({"--coverage", options.coverage});
  return pictures;
}

// Returns all outputs, except the map if the command writes the map of its input folder.
std::vector<OutputPath> OutputsOf(const DisparityOptions& options, const Plan& plan) {
  std::vector<OutputPath> outputs = PicturesOf(options, plan);
  if (!options.out.empty()) outputs.insert(outputs.begin(), {"--output", plan.map});
  return outputs;
}

// Checks all options that can be checked before a file is read.
Result<Plan> MakePlan(const DisparityOptions& options) {
  if (options.views.size() == 1 && !options.repair) {
    return Error::Usage("--views", "at least 2 views to estimate disparities", "1 view");
  }
  const std::string& input = options.input.path;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(input, ignored);
  if (options.out.empty() && (input == "-" || std::filesystem::exists(status)) &&
      !std::filesystem::is_directory(status)) {
    return Error::Usage("--output", "--output FILE, because SRC is not a folder", "none");
  }
  Plan plan = {options.out.empty() ? DisparityPath(input) : options.out, ""};
  if (std::filesystem::path(plan.map).extension() != ".pfm") {
    return Error::Usage("--output", "a name that ends in .pfm", plan.map);
  }
  plan.picture = PictureOf(plan.map);
  if (options.repair && options.out.empty()) {
    return Error::Usage("--repair", "the name of the repaired map by --output", "none");
  }
  if (options.repair && options.range) {
    return Error::Usage("--repair", "no --range, because the map defines the range", "both");
  }
  if (!options.repair && !options.coverage.empty() && std::filesystem::is_directory(status)) {
    return Error::Usage("--coverage", "--repair as well, because only a repair finds coverage",
                        "no --repair");
  }
  if (options.out.empty() && HasDisparity(input)) {
    return Expected(plan.map, "no existing map, or another name by --output", "an existing map");
  }
  if (std::filesystem::exists(std::filesystem::symlink_status(plan.picture, ignored))) {
    plan.picture.clear();
  }
  Error error = CheckOutputPath(plan.map);
  for (const OutputPath& picture : PicturesOf(options, plan)) {
    if (!error) error = CheckImageOutput(picture.path);
  }
  if (!error)
    error = CheckApart(
        OutputsOf(options, plan),
        {{input}, {input, options.input.depth, options.input.matte, options.input.right}});
  if (error) return error;
  return plan;
}

// Estimates the map of a light field. Searches the disparity range of the command line if given,
// otherwise finds a range first.
Result<DisparityEstimate> Estimate(const DisparityOptions& options, const Capture& capture) {
  const LightField& light_field = capture.light_field;
  if (Error error = CheckEstimateViews(capture.path, light_field)) return error;
  const Result<DisparityRange> range =
      options.range ? *options.range : FindRange(capture.path, light_field, options.threads);
  if (!range) return range.error();
  return EstimateDisparity(capture.path, light_field, *range, options.threads);
}

// Repairs the map of the input.
Result<DisparityEstimate> Repair(const DisparityOptions& options, const Capture& capture) {
  return RepairDisparity(MapName(capture), capture.light_field,
                         {options.threads, !options.coverage.empty() && capture.matte.alpha.empty(),
                          !options.confidence.empty()});
}

// Replaces the coverage that a repair has found by the coverage of a matte, if there is a matte.
Error Cover(const DisparityOptions& options, Capture* capture, ThreadRunner* runner,
            DisparityEstimate* estimate) {
  if (options.coverage.empty()) return {};
  if (capture->matte.alpha.empty()) {
    if (!estimate->coverage.empty()) return {};
    TellLine(capture->path + ": no coverage is written: " +
             (capture->light_field.views.size() > 1
                  ? "only a repair with one view (--views 1) finds coverage"
                  : "the map has no hair with a closed outline"));
    return {};
  }
  LightField& light_field = capture->light_field;
  if (!std::isfinite(capture->subject)) {
    light_field.disparity = estimate->map;
    const Error error = CoverByMatte(capture->path, capture->matte, runner, &light_field);
    if (error) return error;
  }
  estimate->coverage = light_field.coverage;
  return {};
}

// Returns the map of a photo that needs no repair.
Result<DisparityEstimate> Take(const DisparityOptions& options, Capture* capture) {
  if (!options.confidence.empty()) {
    return Error::Usage("--confidence", "--repair as well, because the map needs no repair",
                        "no --repair");
  }
  DisparityEstimate taken;
  taken.map = std::move(capture->light_field.disparity);
  const starfocus_disparity_stats stats = MeasureDisparity(taken.map);
  taken.range = {static_cast<float>(stats.min), static_cast<float>(stats.max)};
  return taken;
}

// Opens the input. If a map will be estimated, ignores an existing map. The map of a photo is
// always used, because no map can be estimated from one view.
Result<Capture> Open(const DisparityOptions& options, const Plan& plan, ThreadRunner* runner) {
  Result<Capture> capture = OpenInput(options.input);
  if (!capture) return capture;
  if (capture->photo && options.range) {
    return Error::Usage("--range", "several views, because a photo has a map",
                        "the photo " + capture->path);
  }
  if (options.repair && capture->map_path.empty()) {
    return Expected(MapName(*capture), "a disparity map to repair", "no file");
  }
  if (!options.repair && !capture->photo) capture->map_path.clear();
  Error error = CheckApart(OutputsOf(options, plan),
                           {{}, CaptureFiles(*capture), GridsOf(options.input, *capture)});
  if (!error) error = LoadCapture(options.views, &*capture, runner);
  if (error) return error;
  return capture;
}

// Work that makes the map.
enum class Work { kEstimate, kRepair, kTake };

Work ChooseWork(const DisparityOptions& options, const Capture& capture) {
  if (options.repair) return Work::kRepair;
  if (!capture.photo) return Work::kEstimate;
  return capture.care == MapCare::kRepair ? Work::kRepair : Work::kTake;
}

Error WriteMap(const DisparityOptions& options, const Plan& plan, const Image& centre,
               const DisparityEstimate& estimate) {
  Error error = WritePfm(plan.map, estimate.map);
  if (error) return error;
  if (!plan.picture.empty()) {
    error = WriteImage(plan.picture, DrawDisparity(estimate.map));
  } else {
    TellNote(plan.map,
             "no picture of the map is written, because " + PictureOf(plan.map) + " exists");
  }
  if (!error && !options.confidence.empty()) {
    error = WriteImage(options.confidence, estimate.confidence);
  }
  if (!error && !estimate.coverage.empty()) {
    error = WriteImage(options.coverage, DrawLevels(estimate.coverage, centre));
  }
  return error;
}

Error Run(const DisparityOptions& options) {
  SetDecoderThreads(options.threads);
  const Result<Plan> plan = MakePlan(options);
  if (!plan) return plan.error();
  ThreadRunner runner(options.threads);
  Result<Capture> capture = Open(options, *plan, &runner);
  if (!capture) return capture.error();
  const double start = Seconds();
  const Work work = ChooseWork(options, *capture);
  Result<DisparityEstimate> estimate = work == Work::kEstimate ? Estimate(options, *capture)
                                       : work == Work::kRepair ? Repair(options, *capture)
                                                               : Take(options, &*capture);
  if (!estimate) return estimate.error();
  if (Error error = Cover(options, &*capture, &runner, &*estimate)) return error;
  const double seconds = Seconds() - start;
  const LightField& light_field = capture->light_field;
  if (Error error = WriteMap(options, *plan, light_field.views[0], *estimate)) return error;
  const double megapixels = 1e-6 * estimate->map.width * estimate->map.height;
  const int count = work == Work::kEstimate ? EstimateViews(light_field.positions)
                                            : StarWithin(light_field.positions);
  PrintLine(plan->map + ": disparities from " + Short(estimate->range.min) + " to " +
            Short(estimate->range.max) +
            (work == Work::kEstimate ? ", estimated from "
             : work == Work::kRepair ? ", repaired with "
                                     : ", taken from ") +
            std::to_string(count) + (count == 1 ? " view, " : " views, ") + Decimal(seconds, 1) +
            " s, " + Decimal(seconds / megapixels, 1) + " s per megapixel");
  return {};
}

}  // namespace

Command DisparityCommand() {
  const auto options = std::make_shared<DisparityOptions>();
  Command command = {
      "disparity",
      "Estimate the disparity map of a light field, or repair a map",
      {},
      [options] { return Run(*options); },
      {"starfocus disparity lf", "starfocus disparity lf -o repaired.pfm --repair --threads 4"},
      "",
      {{"Input and output",
        {{"SRC", "Light-field folder, or photo with depth"},
         {"--right", "Right picture of a stereo pair whose left picture is SRC"},
         {"--output", "Map (.pfm); a picture of it gets the same name with .png"},
         {"--confidence", "Picture of the confidence of each pixel"}}},
       {"Map",
        {{"--repair", "Repair the map of SRC instead of estimating a new one"},
         {"--range", "Disparities to search"},
         {"--threads", "Number of threads; default: all cores"}}}}};
  AddInputOptions(&command, &options->input);
  AddRightOption(&command, &options->input);
  AddOptions(
      {
          {"-o,--output", "FILE",
           "Map to write (.pfm); a picture of the map (.png, bright is near) gets the "
           "same name unless this file exists; default: disparity.pfm in SRC, if SRC is a folder "
           "without a map",
           &options->out},
          {"--confidence", "FILE",
           "Picture to write of the confidence of each pixel: black for unknown, brighter "
           "for more certain; default: none",
           &options->confidence},
          {"--coverage", "FILE",
           "Picture to write of the coverage: that of the matte of a photo, or with --repair and "
           "one view, that of hair with a closed outline in the map; default: none",
           &options->coverage},
          {"--repair", nullptr,
           "Repair the map of SRC instead of estimating a new one: displaced and blurred "
           "edges, and noise; needs --output; this is the default for depth photos",
           &options->repair},
          {"--range", "MIN:MAX",
           "Disparities to search, in pixels per unit of u, from -500 to 500; default: "
           "the range found in reduced views, at most an eighth of the width",
           Target([range = &options->range](const std::string& text) {
             return ReadRange(text, range);
           })},
          {"--views", "17|9|5|1|U,V:U,V",
           "Views to use: the star of 17, 9 or 5 views, or positions U,V:U,V; with --repair also "
           "1; default: all views of the input",
           Views(&options->views)},
          ThreadsOption(&options->threads),
      },
      &command);
  return command;
}

}  // namespace starfocus
