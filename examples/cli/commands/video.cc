// SPDX-License-Identifier: Apache-2.0
// starfocus video: refocuses a sequence of light fields. In each frame, only blocks that changed
// are computed.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

#include "examples/cli/clip_output.h"
#include "examples/cli/commands.h"
#include "examples/cli/deep_output.h"
#include "examples/cli/engine_run.h"
#include "examples/cli/lens_keys.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/cli/stages.h"
#include "examples/cli/video_clip.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/writers/deep_picture.h"
#include "platform/y4m.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

std::string PicturePath(const std::string& folder, const std::string& picture) {
  return (fs::path(folder) / picture).string();
}

// Returns the input files that no output may overwrite.
std::vector<std::string> FilesOf(const VideoOptions& options, const Video& video) {
  std::vector<std::string> files;
  if (video.is_stream) files = video.stream.Files();
  for (const FrameSource& frame : video.sources) {
    files.push_back(frame.path);
    files.push_back(frame.depth);
    files.push_back(frame.matte);
  }
  for (const std::string& file : {options.lens.timing, options.keys.focus, options.keys.aperture}) {
    std::error_code ignored;
    if (fs::exists(file, ignored)) files.push_back(file);
  }
  return files;
}

// Returns the names of the pictures in an output folder. Streams without a known number of frames
// have no names yet.
std::vector<std::string> PicturesOf(const Video& video) {
  std::vector<std::string> pictures;
  for (const FrameSource& frame : video.sources) pictures.push_back(frame.picture);
  for (size_t k = 0; video.is_stream && k < video.count(); ++k) {
    pictures.push_back(NumberedPicture(k));
  }
  return pictures;
}

// Checks an output folder and its pictures, before the folder exists.
Error CheckFolder(const VideoOptions& options, const std::vector<std::string>& pictures,
                  const std::vector<std::string>& inputs) {
  const std::string& out = options.out;
  std::error_code failure;
  Error error = CheckFolderOutput({"--output", out});
  if (!error && fs::is_directory(out, failure)) {
    for (size_t i = 0; i < pictures.size() && !error; ++i) {
      const std::string path = PicturePath(out, pictures[i]);
      error = KeepsBits(path) ? CheckDeepOutput(path) : CheckImageOutput(path);
    }
  } else if (!error) {
    error = CheckOutputPath(out.substr(0, out.find_last_not_of('/') + 1));
  }
  if (!error) error = CheckFolderApart({"--output", out}, options.inputs);
  if (!error) error = CheckFolderApart({"--output", out}, inputs);
  return error;
}

Error CheckOutputs(const VideoOptions& options, const Video& video) {
  if (Error error = CheckClipName(options.out)) return error;
  std::vector<std::string> paths;
  for (const FrameSource& frame : video.sources) paths.push_back(frame.path);
  std::vector<OutputPath> outputs = {{"--output", options.out}};
  Error error;
  if (KindOfClip(options.out) == ClipKind::kFolder) {
    const std::vector<std::string> pictures = PicturesOf(video);
    error = CheckFolder(options, pictures, paths);
    for (const std::string& picture : pictures) {
      outputs.push_back({"--output", PicturePath(options.out, picture)});
    }
  } else if (KindOfClip(options.out) == ClipKind::kAnimation) {
    error = CheckImageOutput(options.out);
  } else if (isatty(STDOUT_FILENO) == 1) {
    error = Error::Usage("--output", "a pipe or file as standard output", "a terminal");
  }
  if (error) return error;
  if (!options.report.empty()) {
    outputs.push_back({"--report", options.report});
    error = CheckTextOutput(outputs.back(), OutputKind::kJson);
  }
  return !error ? CheckApart(outputs, {paths, FilesOf(options, video)}) : error;
}

// Returns the header of a stream of the pictures.
Y4mHeader HeaderOf(const Video& video) {
  if (video.is_stream) return video.stream.header().Written();
  Y4mHeader header;
  header.width = video.width;
  header.height = video.height;
  if (video.is_deep) header.bits = 10, header.chroma = "420p10";
  return header;
}

// Stage: refocuses the frames, and copies unchanged blocks from the previous picture.
class Refocusing {
 public:
  Refocusing(const VideoOptions& options, const LensPlan& plan, const Video& video)
      : options_(options),
        plan_(plan),
        video_(video),
        run_(plan.options.threads, static_cast<int>(video.count())) {}

  Result<bool> Refocus(ClipFrame* frame) {
    EngineTask task = TaskOf(*frame);
    if (Error error = ChooseFrameBits(frame, &task)) return error;
    LightField now = std::move(frame->capture.light_field);
    frame->capture.light_field.deep_colours = now.deep_colours;
    task.light_field = &now;
    if (Error error = Start(frame->where, task)) return error;
    // The engine compares pictures in RGB of 8 bits that have the same lens.
    const bool is_rgb = now.planar.samples.empty() && !task.planar_picture && !task.deep_views;
    const bool follows = is_rgb && picture_ != nullptr && task.params.focus == focus_ &&
                         task.params.aperture == aperture_;
    Result<EngineResult> result =
        follows ? run_.RefocusAfter(frame->where, task, before_, picture_->picture)
                : run_.Refocus(frame->where, task);
    if (!result) return result.error();
    if (!options_.report.empty()) {
      const bool is_folder = KindOfClip(options_.out) == ClipKind::kFolder;
      report_.Add(is_folder ? PicturePath(options_.out, frame->picture) : frame->where, task,
                  *result);
    }
    focus_ = task.params.focus;
    aperture_ = task.params.aperture;
    before_ = std::move(now);
    frame->result = std::make_shared<const EngineResult>(std::move(*result));
    picture_ = is_rgb ? frame->result : nullptr;
    return true;
  }

  const SeriesReport& report() const { return report_; }

 private:
  EngineTask TaskOf(const ClipFrame& frame) const {
    const LightField& light_field = frame.capture.light_field;
    EngineTask task = MakeTask(plan_, light_field, video_.stats, video_.max_blur, true);
    if (!video_.focus_keys.empty()) task.params.focus = frame.focus;
    if (!video_.aperture_keys.empty()) {
      task.params.aperture = RadiusAt(video_.aperture_keys, options_.keys.easing, frame.index);
    }
    const PlanarImage& planar = light_field.planar;
    const bool is_planar = !planar.samples.empty();
    task.planar_picture = KindOfClip(options_.out) == ClipKind::kStream;
    if (is_planar || task.planar_picture) task.config.features |= STARFOCUS_FEATURE_IMAGES;
    task.planar.matrix = is_planar ? planar.matrix : HeaderOf(video_).matrix();
    task.planar.range = is_planar ? planar.range : HeaderOf(video_).range;
    task.planar.is_deep = planar.is_deep || (task.planar_picture && video_.is_deep);
    return task;
  }

  // Chooses whether the engine reads and writes more than 8 bits.
  Error ChooseFrameBits(ClipFrame* frame, EngineTask* task) const {
    const LightField& light_field = frame->capture.light_field;
    const bool to_folder = KindOfClip(options_.out) == ClipKind::kFolder;
    if (task->planar.is_deep) {
      task->config.features |= STARFOCUS_FEATURE_DEEP;
      task->deep_views = HasDeepCodes(light_field);
      task->deep_picture = to_folder;
      if (!task->deep_views && !light_field.deep.empty()) TellLostBits(frame->capture);
      const int bits = task->deep_views ? light_field.deep[0].bits : 10;
      const int kept = to_folder ? 16 : task->planar_picture ? 10 : 8;
      if (bits <= kept) return {};
      TellNote(frame->where, "pictures of " + std::to_string(kept) + " bits lose the lower " +
                                 std::to_string(bits - kept) + " bits of the colours");
      return {};
    }
    if (!light_field.planar.samples.empty()) return {};
    OutputOptions output;
    output.out = to_folder ? PicturePath(options_.out, frame->picture) : options_.out;
    return ChooseBits(output, to_folder, &frame->capture, task);
  }

  // Creates the engine for the first frame, and again for frames with other bits.
  Error Start(const std::string& where, const EngineTask& task) {
    const bool is_same =
        is_started_ && task.config.features == features_ && task.config.transfer == transfer_;
    is_started_ = true;
    features_ = task.config.features;
    transfer_ = task.config.transfer;
    return is_same ? Error() : run_.Start(where, task);
  }

  const VideoOptions& options_;
  const LensPlan& plan_;
  const Video& video_;
  EngineRun run_;
  bool is_started_ = false;
  decltype(Config::features) features_ = 0;
  decltype(Config::transfer) transfer_ = 0;
  SeriesReport report_;
  LightField before_;
  std::shared_ptr<const EngineResult> picture_;  // of `before_`, if the next frame may follow it
  double focus_ = 0, aperture_ = 0;              // of `picture_`
};

struct Written {
  size_t frames = 0;
  bool is_closed = false;  // true: the reader of a pipe has closed it
  std::string report;
};

// Runs all stages on all frames.
Result<Written> RefocusFrames(const VideoOptions& options, const LensPlan& plan, Video* video,
                              double start) {
  Written written;
  Refocusing refocusing(options, plan, *video);
  const std::unique_ptr<ClipOutput> output = MakeClipOutput(options.out, HeaderOf(*video));
  std::vector<Stage> stages;
  stages.emplace_back([&](ClipFrame* frame) { return ReadFrame(options, plan, video, frame); });
  stages.emplace_back(
      [&](ClipFrame* frame) { return StabiliseFrame(options, plan, video, frame); });
  stages.emplace_back([&](ClipFrame* frame) { return RepairFrame(options, plan, frame); });
  stages.emplace_back([&](ClipFrame* frame) { return refocusing.Refocus(frame); });
  stages.emplace_back([&](ClipFrame* frame) -> Result<bool> {
    Result<bool> open = output->Write(*frame);
    if (open && *open) ++written.frames;
    if (open && !*open) written.is_closed = true;
    return open;
  });
  if (Error error = RunStages(stages, plan.options.threads > 1)) return error;
  if (written.is_closed) return written;
  if (written.frames == 0) return Expected(video->first(), "at least one frame", "none");
  if (Error error = output->Finish()) return error;
  if (!options.report.empty()) written.report = refocusing.report().Text(Seconds() - start);
  return written;
}

Error Run(const VideoOptions& options) {
  SetDecoderThreads(options.lens.threads);
  const double start = Seconds();
  Video video;
  Result<LensPlan> plan = PlanLens(options.lens);
  Error error = plan.error();
  if (!error) error = ReadLensKeys(options, &video);
  if (!error) error = FindInput(options, &video);
  if (!error) error = CheckOutputs(options, video);
  if (!error) error = CheckKeyFrames(video);
  if (!error) error = ScanVideo(options, &*plan, &video);
  if (error) return error;
  const Result<Written> written = RefocusFrames(options, *plan, &video, start);
  if (!written) return written.error();
  if (written->is_closed) return {};
  if (!options.report.empty()) error = WriteText(options.report, written->report);
  if (error) return error;
  if (video.is_stream) video.stream.TellEnd();
  TellLine(OutputName(options.out) + ": " + std::to_string(written->frames) +
           (written->frames == 1 ? " picture, " : " pictures, ") + LensText(*plan) +
           (video.aperture_keys.size() > 1 ? " at the widest" : "") +
           (video.tracks() ? ", following a subject" : ""));
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
       "starfocus video 'in/%05d.png' --depth 'd/%05d.png' -o out --focus-at 320,240"},
      "Frames must have the same size and are taken in the order of SRC. If SRC is one folder\n"
      "that is not a light field, the frames are the light fields or photos in this folder,\n"
      "sorted by the numbers in their names; a pattern such as in/%05d.png means its files.\n"
      "Depth maps without distances get one scale and one near end for all frames. If --depth or\n"
      "--matte is a folder or a pattern, its pictures are paired with the frames by name or\n"
      "number, and with the frames of a Y4M stream in their order; --depth may be a Y4M file, "
      "too.\n"
      "Unless --focus, --focus-range or --focus-keys is given, the first frame determines the\n"
      "focus of all frames: the focus at the pixel of --focus-at, or else the default focus.\n"
      "Modes frame and benchmark choose one number of views for all frames.\n"
      "\n"
      "FFmpeg decodes and encodes streams: ffmpeg -i in.mp4 -f yuv4mpegpipe - |\n"
      "starfocus video - --depth 'd/%05d.png' -o - | ffmpeg -i - out.mp4",
      {{"Input and output",
        {{"SRC", "Frames, a folder or pattern of them, or a stream (-)"},
         {"--output", "Folder, .webp animation, or - for a Y4M stream"},
         {"--depth", "Depth of the frames, if it is separate"},
         {"--matte", "Mattes of the frames, if they have no depth"},
         {"--near", "Shade that is near in depth pictures: white or black"},
         {"--report", "JSON file with the measurements of each frame"}}},
       {"Focus and lens",
        {{"--focus-at", "Pixel in focus in the first frame"},
         {"--focus", "Disparity in focus"},
         {"--focus-keys", "Focus by frame: '0:track=422,414 48:disparity=-3.2'"},
         {"--aperture-keys", "Aperture by frame: '0:f-stop=8 48:f-stop=1.8'"},
         {"--f-stop", "F-stop, such as 2.8; a smaller one blurs more"},
         {"--strength", "Percentage of the blur, 0 to 100"}}}}};
  AddInputOptions(&command, &options->input, &options->inputs);
  command.options[0].help =  // of SRC
      "One or more light-field folders, folders of views with another layout, or depth photos; one "
      "folder or pattern of them; or a Y4M stream in a file, or - for standard input";
  AddOptions(
      {
          {"-o,--output", "DIR|FILE|-",
           "Folder to write a picture with the name of each input into, .webp file for an "
           "animation, or - to write a Y4M stream to standard output",
           &options->out, Use::kRequired},
      },
      &command);
  AddLensOptions(&command, &options->lens);
  AddLensKeyOptions(&command, &options->keys);
  AddMapOptions(&command, &options->map);
  AddOptions(
      {
          {"--stabilise", nullptr,
           "Fuse the map of each frame with those of the frames before, which follow the motion of "
           "the picture, so that the blur does not flicker; this is the default for maps that are "
           "repaired by default",
           &options->stabilise},
          {"--no-stabilise", nullptr, "Use the map of each frame alone", &options->no_stabilise,
           Use::kOptional, "--stabilise"},
          {"--report", "FILE",
           "JSON file to write with the measurements of each frame, such as the number of "
           "reused blocks; default: none",
           &options->report},
      },
      &command);
  return command;
}

}  // namespace starfocus
