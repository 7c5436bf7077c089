// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/input.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "examples/cli/disparity/estimate_run.h"
#include "examples/cli/input/picture_command.h"
#include "examples/cli/input/notes.h"
#include "examples/command_line/options.h"
#include "platform/console.h"
#include "platform/standard_stream.h"

namespace starfocus {
namespace {

Error CheckNear(const DepthOptions& options) {
  if (options.unit == DepthUnit::kNone) return {};
  const bool disparity = options.unit == DepthUnit::kDisparity;
  if (options.near != (disparity ? Near::kBlack : Near::kWhite)) return {};
  return Error::Usage(
      "--near",
      disparity ? "white for --depth-unit disparity" : "black for the distances of --depth-unit",
      disparity ? "black" : "white");
}

// Returns the name of the first depth-picture option that is set, in the order of the help. Returns
// null if all of these options are unset.
const char* DepthOption(const InputOptions& options) {
  if (!options.depth.empty()) return "--depth";
  if (options.map.near != Near::kUnknown) return "--near";
  if (options.map.unit != DepthUnit::kNone) return "--depth-unit";
  if (options.map.orientation != DepthOrientation::kUnknown) return "--depth-orientation";
  return options.map.has_unknown ? "--unknown" : nullptr;
}

// Rejects pipes by name, such as the process substitution `<(cat photo.jpg)` of shells.
Error CheckPipes(const InputOptions& options) {
  for (const std::string& path : {options.path, options.depth, options.right, options.coverage}) {
    std::error_code ignored;
    if (path.empty() || path == "-" || !std::filesystem::is_fifo(path, ignored)) continue;
    return Cannot("read", path,
                  "it is a pipe (the name - reads standard input, as in `cat photo.jpg | starfocus "
                  "info -`)");
  }
  return {};
}

// Checks that the other options fit the right picture of a stereo pair.
Error CheckRight(const InputOptions& options) {
  std::error_code ignored;
  if (options.right.empty()) return {};
  if (options.path == "-") return Error::Usage("--right", "a file as SRC", "standard input");
  if (std::filesystem::is_directory(options.path, ignored)) {
    return Error::Usage("--right", "a photo as SRC", "the folder " + options.path);
  }
  const char* option = DepthOption(options);
  if (option == nullptr) return {};
  return Error::Usage("--right", std::string("no ") + option + ", because the map is estimated",
                      "both");
}

// Estimates a map from the loaded views.
Error Estimate(int threads, Capture* capture) {
  LightField* light_field = &capture->light_field;
  if (light_field->views.size() == 1) {
    return Expected(MapName(*capture),
                    "a disparity map, because none can be estimated from a single view", "no file");
  }
  const Result<DisparityRange> range = FindRange(capture->path, *light_field, threads);
  if (!range) return range.error();
  TellNote(MapName(*capture), "no map found, so disparities from " + Short(range->min) + " to " +
                                  Short(range->max) + " are estimated from " +
                                  std::to_string(EstimateViews(light_field->positions)) + " views");
  Result<DisparityEstimate> estimate =
      EstimateDisparity(capture->path, *light_field, *range, threads);
  if (estimate) light_field->disparity = std::move(estimate->map);
  return estimate.error();
}

}  // namespace

Result<Capture> ReadInput(const InputOptions& options) {
  if (Error error = CheckPipes(options)) return error;
  if (Error error = CheckRight(options)) return error;
  if (options.path == "-") {
    if (options.depth == "-") {
      return Error::Usage("--depth", "a file, because SRC is standard input", "-");
    }
    if (isatty(STDIN_FILENO) == 1) {
      return Expected(InputName(options.path), "a photo from a file or pipe", "a terminal");
    }
  }
  CaptureOptions wanted;
  wanted.depth = options.depth;
  wanted.right = options.right;
  wanted.small_map = true;
  wanted.map = options.map;
  if (Error error = CheckNear(options.map)) return error;
  std::error_code ignored;
  const char* option = DepthOption(options);
  if (option != nullptr && options.path != "-" &&
      std::filesystem::is_directory(options.path, ignored)) {
    return Error::Usage(option, "a photo as SRC", "the folder " + options.path);
  }
  bool estimates = false;
  if (EstimatesDepth(options)) {
    wanted.map.estimate = [&](const Image& photo) {
      estimates = true;
      const std::string name = InputName(options.path);
      const Alpha alpha = options.map.alpha;
      return options.kept != nullptr ? options.kept->Of(name, options.command, alpha, photo)
                                     : RunDepthCommand(name, options.command, alpha, photo);
    };
  }
  Result<Capture> capture = OpenCapture(options.path, wanted);
  if (!capture) return capture;
  if (wanted.map.estimate && !estimates) {
    capture->notes.push_back(std::string("--depth-command is not run, because the input has ") +
                             (capture->map_path.empty() ? "several views" : "depth"));
  }
  if (!options.coverage.empty() || options.ignores_coverage) {
    capture->coverage_path = options.coverage;
  }
  return capture;
}

Result<Capture> OpenInput(const InputOptions& options) {
  Result<Capture> capture = ReadInput(options);
  if (capture) TellNotes(*capture);
  return capture;
}

void TellNotes(const Capture& capture) {
  for (const std::string& note : capture.notes) TellNote(capture.path, note);
}

Error LoadInput(const Positions& views, int threads, Capture* capture) {
  for (const starfocus_position& view : views) {
    // If a view is missing, report an error of the option --views.
    if (SelectViewFiles(capture->path, capture->files, {view})) continue;
    return Error::Usage(
        "--views",
        "some of the " + std::to_string(capture->files.size()) + " views in " + capture->path,
        std::to_string(views.size()) + " views that include " + ViewName(view));
  }
  ThreadRunner runner(threads);
  const Error error = LoadCapture(views, capture, &runner);
  return !error && capture->map_path.empty() ? Estimate(threads, capture) : error;
}

bool WillRepair(const MapOptions& options, const Capture& capture) {
  if (capture.map_path.empty()) return false;
  return options.repair || (!options.no_repair && capture.care == MapCare::kRepair);
}

Error CareForMap(const MapOptions& options, int threads, Capture* capture) {
  if (capture->map_path.empty()) return {};
  if (WillRepair(options, *capture)) {
    // If the input provides coverage, keep this coverage instead of searching for coverage.
    LightField& light_field = capture->light_field;
    const bool covers = light_field.coverage.empty();
    Result<DisparityEstimate> repaired =
        RepairDisparity(MapName(*capture), light_field, {threads, covers, false});
    if (!repaired) return repaired.error();
    light_field.disparity = std::move(repaired->map);
    if (covers) light_field.coverage = std::move(repaired->coverage);
    return {};
  }
  if (!options.fill && capture->care == MapCare::kNone) return {};
  return FillHoles(MapName(*capture), &capture->light_field.disparity);
}

Error FillHoles(const std::string& where, FloatMap* map) {
  const starfocus_status status =
      starfocus_fill_disparity(map->values.data(), map->stride(), map->width, map->height);
  return status == STARFOCUS_OK ? Error()
                                : Expected(where, "a map with finite disparities", "none");
}

std::vector<std::string> GridsOf(const InputOptions& options, const Capture& capture) {
  const std::filesystem::path first = capture.files[0].path;
  if (capture.photo || IsViewFile(first.filename().string())) return {};
  return {options.path};
}

std::string MapName(const Capture& capture) {
  if (!capture.map_path.empty()) return InputName(capture.map_path);
  std::error_code ignored;
  const bool folder = std::filesystem::is_directory(capture.path, ignored);
  return folder ? DisparityPath(capture.path) : capture.path;
}

}  // namespace starfocus
