// SPDX-License-Identifier: Apache-2.0
// starfocus video: refocuses a sequence of light fields. In each frame, only blocks that changed
// are computed.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/engine/engine_run.h"
#include "examples/cli/input/input.h"
#include "examples/cli/refocus/refocus_plan.h"
#include "examples/cli/refocus/refocus_report.h"
#include "examples/command_line/outputs.h"
#include "platform/clock.h"
#include "platform/folder.h"
#include "platform/image_io.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// Largest number of frames, because file names have four digits.
constexpr size_t kMostFrames = 10000;

struct VideoOptions {
  std::vector<std::string> folders;
  std::string out, report;
  LensOptions lens;
  bool fill_invalid = false;
};

// Frames of a video and their common properties.
struct Video {
  std::vector<std::string> folders;
  int width = 0, height = 0;
  Positions views;
  starfocus_disparity_stats stats = {};  // over all frames
  double max_blur = 0;
};

std::string FramePath(const std::string& folder, size_t index) {
  char name[32];
  std::snprintf(name, sizeof(name), "frame_%04d.png", static_cast<int>(index));
  return (fs::path(folder) / name).string();
}

// Returns the folders of the frames, which are the given folders. If the only given folder is not a
// light field, returns its subfolders instead. Hidden folders and the output folder are omitted
// from the subfolders.
Result<std::vector<std::string>> FindFrames(const VideoOptions& options) {
  std::vector<std::string> folders = options.folders;
  std::error_code error;
  const std::string only = folders[0];
  if (folders.size() == 1 && fs::is_directory(only, error) &&
      !fs::exists(DisparityPath(only), error)) {
    folders.clear();
    for (const auto& entry : fs::directory_iterator(only, error)) {
      const bool hidden = entry.path().filename().string()[0] == '.';
      const bool own = fs::equivalent(entry.path(), options.out, error);  // earlier output
      if (entry.is_directory(error) && !hidden && !own) folders.push_back(entry.path().string());
    }
    std::sort(folders.begin(), folders.end());
    if (folders.empty()) return Expected(only, "light-field folders in this folder", "none");
  }
  if (folders.size() <= kMostFrames) return folders;
  return Error::Usage("DIR", "at most " + std::to_string(kMostFrames) + " frames",
                      std::to_string(folders.size()));
}

Error CheckOutputs(const VideoOptions& options, const Video& video) {
  std::error_code failure;
  Error error;
  if (options.out.empty()) return Error::Usage("--output", "a folder", "an empty name");
  if (fs::is_directory(options.out, failure)) {
    for (size_t i = 0; i < video.folders.size() && !error; ++i) {
      error = CheckImageOutput(FramePath(options.out, i));
    }
  } else {
    error = CheckFolderOutput(options.out);
    if (!error) error = CheckOutputPath(options.out);
  }
  if (!error) error = CheckFolderApart({"--output", options.out}, video.folders);
  if (error) return error;
  std::vector<Output> outputs = {{"--output", options.out}};
  for (size_t i = 0; i < video.folders.size(); ++i) {
    outputs.push_back({"--output", FramePath(options.out, i)});
  }
  if (!options.report.empty()) {
    error = CheckOutputPath(options.report);
    outputs.push_back({"--report", options.report});
  }
  return !error ? CheckApart(outputs, {video.folders, {options.lens.timing}}) : error;
}

Error CheckSize(const std::string& folder, const FloatMap& map, const Video& video) {
  if (map.width == video.width && map.height == video.height) return {};
  return Expected(folder,
                  SizeText(video.width, video.height) + " pixels, the size of the first frame",
                  SizeText(map.width, map.height));
}

// Measures the map of a folder, after filling its holes if requested.
Result<starfocus_disparity_stats> Prepare(const VideoOptions& options, const std::string& folder,
                                          FloatMap* map) {
  const std::string path = DisparityPath(folder);
  if (options.fill_invalid) {
    if (Error error = FillHoles(path, map)) return error;
  }
  return PrepareDisparity(path, *map);
}

// Sets the focus of all frames to the focus of the first frame.
Error FocusFirst(const std::string& folder, const FloatMap& map, LensPlan* plan) {
  if (plan->focus_option.empty()) {
    const DefaultFocus focus = FindSurface(map);
    TellFocus(folder, focus);
    UseFocus(focus, plan);
  }
  return ChooseFocus(map, plan);
}

// Reads the views and disparities of all frames.
Error Scan(const VideoOptions& options, LensPlan* plan, Video* video) {
  const auto chosen = ChooseViewFiles(video->folders[0], plan->options.views);
  if (!chosen) return chosen.error();
  for (const ViewFile& file : *chosen) video->views.push_back(file.position);
  if (Error error = CheckRenderer(video->folders[0], *plan, video->views)) return error;
  for (size_t i = 0; i < video->folders.size(); ++i) {
    const std::string& folder = video->folders[i];
    if (Error error = ChooseViewFiles(folder, video->views).error()) return error;
    FloatMap map;
    if (Error error = ReadDisparity(folder).MoveTo(&map)) return error;
    if (i == 0) video->width = map.width, video->height = map.height;
    if (Error error = CheckSize(folder, map, *video)) return error;
    const Result<starfocus_disparity_stats> stats = Prepare(options, folder, &map);
    if (!stats) return stats.error();
    if (i == 0) {
      if (Error error = FocusFirst(folder, map, plan)) return error;
    }
    video->stats.min = i == 0 ? stats->min : std::min(video->stats.min, stats->min);
    video->stats.max = i == 0 ? stats->max : std::max(video->stats.max, stats->max);
  }
  if (Error error = ChooseBlur(video->stats, plan).MoveTo(&video->max_blur)) return error;
  TellAperture(video->folders[0], plan->aperture);
  return {};
}

Result<LightField> LoadFrame(const VideoOptions& options, const Video& video, size_t index) {
  const std::string& folder = video.folders[index];
  Result<LightField> frame = LoadLightField(folder, video.views);
  if (!frame) return frame;
  if (Error error = CheckSize(folder, frame->disparity, video)) return error;
  if (Error error = Prepare(options, folder, &frame->disparity).error()) return error;
  return frame;
}

Result<SeriesReport> RefocusFrames(const VideoOptions& options, const LensPlan& plan,
                                   const Video& video) {
  SeriesReport report;
  EngineRun run(plan.options.threads, static_cast<int>(video.folders.size()));
  LightField now, before;
  Image picture;
  for (size_t i = 0; i < video.folders.size(); ++i) {
    const std::string &folder = video.folders[i], out = FramePath(options.out, i);
    before = std::move(now);
    if (Error error = LoadFrame(options, video, i).MoveTo(&now)) return error;
    const EngineTask task = MakeTask(plan, now, video.stats, video.max_blur, true);
    if (Error error = i == 0 ? run.Start(folder, task) : Error()) return error;
    Result<EngineResult> result =
        i == 0 ? run.Refocus(folder, task) : run.RefocusAfter(folder, task, before, picture);
    if (!result) return result.error();
    if (Error error = WriteImage(out, result->picture)) return error;
    report.Add(out, task, *result);
    picture = std::move(result->picture);
  }
  return report;
}

Error Run(const VideoOptions& options) {
  const double start = Seconds();
  Video video;
  Result<LensPlan> plan = PlanLens(options.lens);
  Error error = plan.error();
  if (!error) error = PlanAperture(options.lens.aperture, {}).MoveTo(&plan->aperture);
  if (!error) error = FindFrames(options).MoveTo(&video.folders);
  if (!error) error = CheckOutputs(options, video);
  if (!error) error = Scan(options, &*plan, &video);
  if (!error) error = MakeFolder(options.out);
  if (error) return error;
  const Result<SeriesReport> report = RefocusFrames(options, *plan, video);
  if (!report || options.report.empty()) return report.error();
  return WriteText(options.report, report->Text(Seconds() - start));
}

}  // namespace

Command VideoCommand() {
  const auto options = std::make_shared<VideoOptions>();
  Command command = {
      "video",
      "Refocus one light field after another, and copy the blocks that did not change",
      {},
      [options] { return Run(*options); },
      {"starfocus video frames -o out --focus 2",
       "starfocus video lf0 lf1 lf2 -o out --focus-at 320,240 --report report.json"},
      "The first frame sets the focus of all frames: at the pixel of --focus-at, or by default if "
      "no\n"
      "option sets it. Modes frame and benchmark choose one number of views for all frames."};
  AddOptions(
      {
          {"DIR", "DIR",
           "Light-field folders of the same size, in order, or one folder that contains "
           "such folders, sorted by name",
           &options->folders, Use::kRequired},
          {"-o,--output", "DIR", "Folder to write frame_0000.png, frame_0001.png, ... into",
           &options->out, Use::kRequired},
      },
      &command);
  AddLensOptions(&command, &options->lens);
  AddOptions(
      {
          {"--fill-invalid", nullptr,
           "Replace non-finite disparities by the nearest valid disparity", &options->fill_invalid},
          {"--report", "FILE",
           "JSON file to write with the measurements of each frame, such as the number of "
           "reused blocks; default: none",
           &options->report},
      },
      &command);
  return command;
}

}  // namespace starfocus
