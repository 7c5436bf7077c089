// SPDX-License-Identifier: Apache-2.0
// starfocus video: refocuses a sequence of light fields. In each frame, only blocks that changed
// are computed.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "examples/cli/commands.h"
#include "examples/cli/engine_run.h"
#include "examples/cli/frames.h"
#include "examples/cli/input.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/folder.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "platform/text.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

struct VideoOptions {
  std::vector<std::string> inputs;
  InputOptions input;  // options of each input
  std::string out, report;
  LensOptions lens;
  MapOptions map;
};

// Frames of a video and their common properties.
struct Video {
  std::vector<FrameSource> sources;
  MapSurvey survey;  // of the depth maps of all frames
  KeptPictures computed;
  FrameFolders converted;
  std::vector<FrameFiles> frames;  // frames that are open, in the order of `sources`
  int width = 0, height = 0;
  Positions views;
  starfocus_disparity_stats stats = {};  // over all frames
  double max_blur = 0;
};

std::string PicturePath(const std::string& folder, const FrameSource& frame) {
  return (fs::path(folder) / frame.picture).string();
}

// Returns the input files that no output may overwrite.
std::vector<std::string> FilesOf(const VideoOptions& options, const Video& video) {
  std::vector<std::string> files = {options.lens.timing};
  for (const FrameSource& frame : video.sources) {
    files.push_back(frame.path);
    files.push_back(frame.depth);
    files.push_back(frame.matte);
  }
  return files;
}

Error CheckOutputs(const VideoOptions& options, const Video& video) {
  std::error_code failure;
  Error error;
  if (options.out.empty()) return Error::Usage("--output", "a folder", "an empty name");
  error = CheckFolderOutput({"--output", options.out});
  if (fs::is_directory(options.out, failure)) {
    for (size_t i = 0; i < video.sources.size() && !error; ++i) {
      error = CheckImageOutput(PicturePath(options.out, video.sources[i]));
    }
  } else if (!error) {
    const std::string& out = options.out;
    error = CheckOutputPath(out.substr(0, out.find_last_not_of('/') + 1));
  }
  if (!error) error = CheckFolderApart({"--output", options.out}, options.inputs);
  std::vector<std::string> paths;
  for (const FrameSource& frame : video.sources) paths.push_back(frame.path);
  if (!error) error = CheckFolderApart({"--output", options.out}, paths);
  if (error) return error;
  std::vector<OutputPath> outputs = {{"--output", options.out}};
  for (const FrameSource& frame : video.sources) {
    outputs.push_back({"--output", PicturePath(options.out, frame)});
  }
  if (!options.report.empty()) {
    outputs.push_back({"--report", options.report});
    error = CheckTextOutput(outputs.back(), OutputKind::kJson);
  }
  return !error ? CheckApart(outputs, {paths, FilesOf(options, video)}) : error;
}

Error CheckSize(const std::string& where, const FloatMap& map, const Video& video) {
  if (map.width == video.width && map.height == video.height) return {};
  return Expected(where,
                  SizeText(video.width, video.height) + " pixels, the size of the first frame",
                  SizeText(map.width, map.height));
}

// Measures the map of a frame, after filling its holes if requested.
Result<starfocus_disparity_stats> Prepare(const VideoOptions& options, const std::string& where,
                                          FloatMap* map) {
  if (options.map.fill) {
    if (Error error = FillHoles(where, map)) return error;
  }
  return PrepareDisparity(where, *map);
}

// Opens a frame. The first frame sets the aperture and the views of all frames.
Result<Frame> OpenFrame(const VideoOptions& options, const FrameSource& source, LensPlan* plan,
                        Video* video) {
  InputOptions one = OptionsOf(options.input, source);
  one.kept = &video->computed;
  one.map.clip = &video->survey;
  Result<Capture> capture = ReadInput(one);
  if (!capture) return capture.error();
  TellNotes(*capture);
  TellLost(*capture);
  const bool is_first = video->frames.empty();
  if (is_first) {
    Error error = PlanAperture(options.lens.aperture, *capture).MoveTo(&plan->aperture);
    if (error) return error;
  }
  Result<Frame> frame = video->converted.Open(
      options.map, is_first ? plan->options.views : video->views, plan->options.threads, &*capture);
  if (!frame) return frame;
  const auto chosen =
      ChooseViewFiles(frame->files.folder, is_first ? plan->options.views : video->views);
  if (!chosen) return chosen.error();
  if (!is_first) return frame;
  for (const ViewFile& file : *chosen) video->views.push_back(file.position);
  if (Error error = CheckRenderer(source.path, *plan, video->views)) return error;
  return frame;
}

// Adds a frame. The first frame sets the size and the focus of all frames.
Error AddFrame(const VideoOptions& options, const std::string& input, Frame frame, LensPlan* plan,
               Video* video) {
  const bool is_first = video->frames.empty();
  if (is_first) video->width = frame.map.width, video->height = frame.map.height;
  if (Error error = CheckSize(input, frame.map, *video)) return error;
  if (!is_first && frame.files.is_linear != video->frames[0].is_linear) {
    return Expected(input, "light coded as in the first frame",
                    frame.files.is_linear ? "linear light" : "codes that are not linear");
  }
  const Result<starfocus_disparity_stats> stats = Prepare(options, frame.files.where, &frame.map);
  if (!stats) return stats.error();
  if (is_first) {
    if (plan->focus_option.empty()) {
      TellFocus(input, frame.focus);
      UseFocus(frame.focus, plan);
    }
    if (Error error = ChooseFocus(frame.map, plan)) return error;
    video->stats = *stats;
  }
  video->stats.min = std::min(video->stats.min, stats->min);
  video->stats.max = std::max(video->stats.max, stats->max);
  video->frames.push_back(std::move(frame.files));
  return {};
}

// Opens all frames and measures their maps.
Error Scan(const VideoOptions& options, LensPlan* plan, Video* video) {
  InputOptions input = options.input;
  input.kept = &video->computed;
  if (Error error = SurveyClip(video->sources, input).MoveTo(&video->survey)) return error;
  for (const FrameSource& source : video->sources) {
    Result<Frame> frame = OpenFrame(options, source, plan, video);
    if (!frame) return frame.error();
    if (Error error = AddFrame(options, source.path, std::move(*frame), plan, video)) return error;
  }
  if (Error error = ChooseBlur(video->stats, plan).MoveTo(&video->max_blur)) return error;
  TellAperture(video->sources[0].path, plan->aperture);
  TellBlurred(video->sources[0].path, video->stats, SharpRadius(video->width, video->height),
              *plan);
  return {};
}

Result<LightField> LoadFrame(const VideoOptions& options, const Video& video, size_t index) {
  Result<LightField> frame = LoadLightField(video.frames[index].folder, video.views);
  if (!frame) return frame;
  frame->is_linear = video.frames[index].is_linear;
  if (Error error = CheckSize(video.sources[index].path, frame->disparity, video)) return error;
  if (Error error = Prepare(options, video.frames[index].where, &frame->disparity).error())
    return error;
  return frame;
}

Result<SeriesReport> RefocusFrames(const VideoOptions& options, const LensPlan& plan,
                                   const Video& video) {
  SeriesReport report;
  EngineRun run(plan.options.threads, static_cast<int>(video.frames.size()));
  LightField now, before;
  Image picture;
  for (size_t i = 0; i < video.frames.size(); ++i) {
    const std::string& input = video.sources[i].path;
    const std::string out = PicturePath(options.out, video.sources[i]);
    before = std::move(now);
    if (Error error = LoadFrame(options, video, i).MoveTo(&now)) return error;
    const EngineTask task = MakeTask(plan, now, video.stats, video.max_blur, true);
    if (Error error = i == 0 ? run.Start(input, task) : Error()) return error;
    Result<EngineResult> result =
        i == 0 ? run.Refocus(input, task) : run.RefocusAfter(input, task, before, picture);
    if (!result) return result.error();
    PictureOptions how;
    how.metadata.icc = video.frames[i].icc;
    how.metadata.colours = video.frames[i].colours;
    if (Error error = WriteImage(out, result->picture, how)) return error;
    report.Add(out, task, *result);
    picture = std::move(result->picture);
  }
  return report;
}

Error Run(const VideoOptions& options) {
  SetDecoderThreads(options.lens.threads);
  const double start = Seconds();
  Video video;
  Result<LensPlan> plan = PlanLens(options.lens);
  Error error = plan.error();
  if (!error) {
    error = FindFrames(options.inputs, options.input, options.out).MoveTo(&video.sources);
  }
  if (!error) error = CheckOutputs(options, video);
  if (!error) error = Scan(options, &*plan, &video);
  OutputFolder made;
  if (!error) error = made.Create(options.out);
  if (error) return error;
  const Result<SeriesReport> report = RefocusFrames(options, *plan, video);
  error = report.error();
  if (!error && !options.report.empty()) {
    error = WriteText(options.report, report->Text(Seconds() - start));
  }
  if (error) return error;
  TellLine(options.out + ": " + std::to_string(video.frames.size()) +
           (video.frames.size() == 1 ? " picture, " : " pictures, ") + LensText(*plan));
  return {};
}

}  // namespace

Command VideoCommand() {
  const auto options = std::make_shared<VideoOptions>();
  Command command = {
      "video",
      "Refocus the frames of a video, which are light fields or photos",
      {},
      [options] { return Run(*options); },
      {"starfocus video frames -o out --focus 2",
       "starfocus video rgb --depth depth -o out --near white --focus-at 320,240"},
      "Frames must have the same size and are taken in the order of SRC. If SRC is one folder\n"
      "that is not a light field, the frames are the light fields or photos in this folder,\n"
      "sorted by the numbers in their names. Depth maps without distances get one scale and one\n"
      "near end for all frames. If --depth or --matte is a folder, its pictures are paired with\n"
      "the frames by name, or else by number. Unless --focus or --focus-range is given, the first\n"
      "frame determines the focus of all frames: the focus at the pixel of --focus-at, or else\n"
      "the default focus. Modes frame and benchmark choose one number of views for all frames.",
      {{"Input and output",
        {{"SRC", "Frames, or one folder that contains the frames"},
         {"--output", "Folder for the pictures"},
         {"--depth", "Depth of the frames, if it is separate"},
         {"--matte", "Mattes of the frames, if they have no depth"},
         {"--near", "Shade that is near in depth pictures: white or black"},
         {"--report", "JSON file with the measurements of each frame"}}},
       {"Focus and lens, the same for all frames",
        {{"--focus-at", "Pixel in focus in the first frame"},
         {"--focus", "Disparity in focus"},
         {"--f-stop", "F-stop, such as 2.8; a smaller one blurs more"},
         {"--strength", "Percentage of the blur, 0 to 100"}}}}};
  AddInputOptions(&command, &options->input, &options->inputs);
  AddOptions(
      {
          {"-o,--output", "DIR", "Folder to write a PNG picture with the name of each input into",
           &options->out, Use::kRequired},
      },
      &command);
  AddLensOptions(&command, &options->lens);
  AddMapOptions(&command, &options->map);
  AddOptions(
      {
          {"--report", "FILE",
           "JSON file to write with the measurements of each frame, such as the number of "
           "reused blocks; default: none",
           &options->report},
      },
      &command);
  return command;
}

}  // namespace starfocus
