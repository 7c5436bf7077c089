// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/input/input.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "examples/cli/disparity/estimate_run.h"
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

// Returns the name of the first option of a depth picture or a matte that is set. Returns null if
// all of these options are unset.
const char* PhotoOption(const InputOptions& options) {
  if (!options.depth.empty()) return "--depth";
  if (options.map.near != Near::kUnknown) return "--near";
  if (options.map.unit != DepthUnit::kNone) return "--depth-unit";
  if (options.map.orientation != DepthOrientation::kUnknown) return "--depth-orientation";
  if (options.map.has_unknown) return "--unknown";
  return options.matte.empty() ? nullptr : "--matte";
}

// Rejects pipes by name, such as the process substitution `<(cat photo.jpg)` of shells.
Error CheckPipes(const InputOptions& options) {
  for (const std::string& path :
       {options.path, options.depth, options.matte, options.right, options.coverage}) {
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
  const char* option = PhotoOption(options);
  if (option == nullptr) return {};
  return Error::Usage("--right", std::string("no ") + option + ", because the map is estimated",
                      "both");
}

// Checks the files of the options, apart from --right.
Error CheckFiles(const InputOptions& options) {
  const bool is_stream = options.path == "-";
  const bool covers = !options.coverage.empty() || options.ignores_coverage;
  if (covers && (!options.matte.empty() || !options.matte_command.line.empty())) {
    return Error::Usage("--coverage", "either --coverage or a matte", "both");
  }
  for (const auto& [name, file] :
       {std::pair("--depth", options.depth), {"--matte", options.matte}}) {
    if (is_stream && file == "-") {
      return Error::Usage(name, "a file, because SRC is standard input", "-");
    }
  }
  if (is_stream && isatty(STDIN_FILENO) == 1) {
    return Expected(InputName(options.path), "a photo from a file or pipe", "a terminal");
  }
  const char* option = PhotoOption(options);
  std::error_code ignored;
  if (option == nullptr || is_stream || !std::filesystem::is_directory(options.path, ignored)) {
    return {};
  }
  return Error::Usage(option, "a photo as SRC", "the folder " + options.path);
}

// Runs a command, if it is given, when the reader of the photo needs the picture.
struct CommandRun {
  const InputOptions& options;
  const PictureCommand& command;
  Alpha alpha;
  bool has_run = false;

  std::function<Result<Samples>(const Image&)> call() {
    if (command.line.empty()) return nullptr;
    return [this](const Image& photo) {
      has_run = true;
      const CommandInput input = {InputName(options.path), photo, alpha, options.seconds};
      return options.kept != nullptr ? options.kept->Of(command, input)
                                     : RunPictureCommand(command, input);
    };
  }
  // Adds a note if the command was given but has not run.
  void NoteUnused(const std::string& present, Capture* capture) const {
    if (command.line.empty() || has_run) return;
    capture->notes.push_back(std::string("--") + command.kind +
                             "-command is not run, because the input has " + present);
  }
};

// Returns what makes a matte unnecessary: `of_photo`, or the views of a folder.
std::string Present(const std::string& of_photo, const Capture& capture) {
  return capture.photo ? of_photo : capture.files.size() > 1 ? "several views" : "a map";
}

// Adds a note if --floor is given for an input that has depth or several views, as in a batch.
void NoteUnusedFloor(Capture* capture) {
  if (std::isfinite(capture->subject)) return;
  capture->notes.push_back("--floor is not used, because the input has " +
                           Present("depth", *capture));
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
  if (Error error = CheckNear(options.map)) return error;
  if (Error error = CheckFiles(options)) return error;
  CommandRun depth = {options, options.depth_command, options.map.alpha};
  CommandRun matte = {options, options.matte_command, Alpha::kTaken};
  CaptureOptions wanted;
  wanted.depth = options.depth;
  wanted.matte = options.matte;
  wanted.right = options.right;
  wanted.small_map = true;
  wanted.map = options.map;
  wanted.map.estimate = depth.call();
  wanted.map.estimate_matte = matte.call();
  Result<Capture> capture = OpenCapture(options.path, wanted);
  if (!capture) return capture;
  depth.NoteUnused(capture->map_path.empty() ? "several views" : "depth", &*capture);
  matte.NoteUnused(Present("a matte", *capture), &*capture);
  if (options.map.floor) NoteUnusedFloor(&*capture);
  if (!options.coverage.empty() || options.ignores_coverage) {
    capture->coverage_path = options.coverage;
    capture->light_field.coverage.clear();
    capture->covers_by_matte = false;
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
  // If the input provides coverage, keep this coverage instead of searching for coverage.
  LightField& light_field = capture->light_field;
  const bool has_coverage = !light_field.coverage.empty();
  const bool has_matte = capture->covers_by_matte && !capture->matte.alpha.empty();
  if (WillRepair(options, *capture)) {
    const bool covers = !has_coverage && !has_matte;
    Result<DisparityEstimate> repaired =
        RepairDisparity(MapName(*capture), light_field, {threads, covers, false});
    if (!repaired) return repaired.error();
    light_field.disparity = std::move(repaired->map);
    if (covers) light_field.coverage = std::move(repaired->coverage);
  } else if (options.fill || capture->care != MapCare::kNone) {
    if (Error error = FillHoles(MapName(*capture), &light_field.disparity)) return error;
  }
  if (has_coverage || !has_matte) return {};
  ThreadRunner runner(threads);
  return CoverByMatte(capture->path, capture->matte, &runner, &light_field);
}

Error FillHoles(const std::string& where, FloatMap* map) {
  const starfocus_status status =
      starfocus_fill_disparity(map->values.data(), map->stride(), map->width, map->height, nullptr);
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
