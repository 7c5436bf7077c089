// SPDX-License-Identifier: Apache-2.0
// starfocus video: refocuses a sequence of light fields. In each frame, only blocks that changed
// are computed.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "examples/cli/clip_output.h"
#include "examples/cli/commands.h"
#include "examples/cli/engine_run.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/frames.h"
#include "examples/cli/input.h"
#include "examples/cli/lens_keys.h"
#include "examples/cli/refocus_output.h"
#include "examples/cli/refocus_plan.h"
#include "examples/cli/stages.h"
#include "examples/cli/stream_clip.h"
#include "examples/command_line/program.h"
#include "platform/clock.h"
#include "platform/console.h"
#include "platform/folder.h"
#include "platform/helper/decoder_threads.h"
#include "platform/image_io.h"
#include "platform/standard_stream.h"
#include "platform/text.h"
#include "platform/y4m.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

struct VideoOptions {
  std::vector<std::string> inputs;
  InputOptions input;  // options of each input
  std::string out, report;
  LensOptions lens;
  LensKeyOptions keys;
  MapOptions map;
};

// Frames of a video and their common properties.
struct Video {
  bool is_stream = false;            // true: the frames are those of `stream`; false: of `sources`
  StreamClip stream;
  std::vector<FrameSource> sources;
  MapSurvey survey;  // of the depth maps of all frames
  KeptPictures computed;
  FrameFolders converted;
  std::vector<FrameFiles> frames;  // frames that are open, in the order of `sources`
  int width = 0, height = 0;
  Positions views;
  starfocus_disparity_stats stats = {};  // over all frames
  double max_blur = 0;
  std::vector<FocusKey> focus_keys;
  std::vector<ApertureKey> aperture_keys;

  // Returns the name of the first frame, for notes about all frames.
  const std::string& first() const { return is_stream ? stream.where() : sources[0].path; }
  // Returns the number of frames; 0: unknown.
  size_t count() const { return is_stream ? stream.maps() : sources.size(); }
};

std::string PicturePath(const std::string& folder, const std::string& picture) {
  return (fs::path(folder) / picture).string();
}

// Returns the name of the picture of a frame of a stream.
std::string NumberedPicture(size_t frame) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%04zu.png", frame);
  return name;
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

// Returns the names of the pictures in an output folder, as far as they are known.
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
      error = CheckImageOutput(PicturePath(out, pictures[i]));
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

// Reads the keys, and checks that no other option sets what they set.
Error ReadLensKeys(const VideoOptions& options, Video* video) {
  const LensOptions& lens = options.lens;
  if (!options.keys.focus.empty() && (lens.focus || lens.focus_at || lens.focus_range)) {
    const char* other = lens.focus ? "--focus" : lens.focus_at ? "--focus-at" : "--focus-range";
    return Error::Usage("--focus-keys", std::string("either --focus-keys or ") + other, "both");
  }
  const ApertureOptions& fixed = lens.aperture;
  if (!options.keys.aperture.empty() && (fixed.aperture || fixed.f_stop || fixed.strength)) {
    const char* other = fixed.aperture ? "--aperture" : fixed.f_stop ? "--f-stop" : "--strength";
    return Error::Usage("--aperture-keys", std::string("either --aperture-keys or ") + other,
                        "both");
  }
  if (Error error = ReadFocusKeys(options.keys.focus).MoveTo(&video->focus_keys)) return error;
  return ReadApertureKeys(options.keys.aperture).MoveTo(&video->aperture_keys);
}

Error CheckKeyFrames(const Video& video) {
  if (video.count() == 0) return {};
  Error error;
  if (!video.focus_keys.empty()) {
    const FocusKey& last = video.focus_keys.back();
    error = CheckLastKey("--focus-keys", last.frame, last.text, video.count());
  }
  if (!error && !video.aperture_keys.empty()) {
    const ApertureKey& last = video.aperture_keys.back();
    error = CheckLastKey("--aperture-keys", last.frame, last.text, video.count());
  }
  return error;
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

// Sets the aperture of all frames, or of each key, from the lens of the first frame.
Error PlanApertures(const VideoOptions& options, const Capture& first, LensPlan* plan,
                    Video* video) {
  if (video->aperture_keys.empty()) {
    return PlanAperture(options.lens.aperture, first).MoveTo(&plan->aperture);
  }
  double widest = -1;
  for (ApertureKey& key : video->aperture_keys) {
    if (key.options.f_stop) key.options.widest = options.lens.aperture.widest;
    const Result<ApertureChoice> choice = PlanAperture(key.options, first);
    if (!choice) return choice.error();
    key.radius = choice->radius;
    if (key.radius <= widest) continue;
    widest = key.radius;
    plan->aperture = *choice;
    plan->aperture.option = "--aperture-keys";
    plan->aperture.value = key.text;
  }
  return {};
}

// Finds the disparities of the keys that name a pixel of the frame.
Error FindKeys(size_t frame, const std::string& where, const FloatMap& map, Video* video) {
  for (FocusKey& key : video->focus_keys) {
    if (key.frame != frame || !key.at) continue;
    const Result<std::optional<double>> focus =
        FocusOfPixel("--focus-keys", *key.at, video->width, video->height, map);
    if (!focus) return focus.error();
    if (!*focus) return Expected(where, "known disparities around " + key.text, "none");
    key.disparity = **focus;
  }
  return {};
}

// Sets the focus of all frames from the first frame, unless there are keys.
Error ChooseFirstFocus(const std::string& input, const DefaultFocus& focus, const FloatMap& map,
                       LensPlan* plan, Video* video) {
  if (!video->focus_keys.empty()) return {};
  if (plan->focus_option.empty()) {
    TellFocus(input, focus);
    UseFocus(focus, plan);
  }
  if (!plan->foci.empty()) return {};
  const Result<std::optional<double>> found =
      FocusOfPixel("--focus-at", {plan->x, plan->y}, video->width, video->height, map);
  if (!found) return found.error();
  if (!*found) return Expected(input, "known disparities around the focus", "none");
  plan->foci = {**found};
  return {};
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
    if (Error error = PlanApertures(options, *capture, plan, video)) return error;
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
  Error error = FindKeys(video->frames.size(), input, frame.map, video);
  if (!error && is_first) {
    error = ChooseFirstFocus(input, frame.focus, frame.map, plan, video);
    video->stats = *stats;
  }
  if (error) return error;
  video->stats.min = std::min(video->stats.min, stats->min);
  video->stats.max = std::max(video->stats.max, stats->max);
  video->frames.push_back(std::move(frame.files));
  return {};
}

// Opens all frames and measures their maps.
Error ScanFiles(const VideoOptions& options, LensPlan* plan, Video* video) {
  InputOptions input = options.input;
  input.kept = &video->computed;
  const auto open = [&](size_t frame, const MapSurvey* clip) {
    InputOptions one = OptionsOf(input, video->sources[frame]);
    one.map.clip = clip;
    return ReadInput(one);
  };
  if (Error error = SurveyClip(video->sources.size(), open).MoveTo(&video->survey)) return error;
  for (const FrameSource& source : video->sources) {
    Result<Frame> frame = OpenFrame(options, source, plan, video);
    if (!frame) return frame.error();
    if (Error error = AddFrame(options, source.path, std::move(*frame), plan, video)) return error;
  }
  return {};
}

// Measures a map of a stream. The first map sets the focus and the aperture of all frames.
Error AddMap(const VideoOptions& options, size_t frame, const Capture& map, LensPlan* plan,
             Video* video) {
  const bool is_first = frame == 0;
  const FloatMap& disparity = map.light_field.disparity;
  Result<starfocus_disparity_stats> stats = PrepareDisparity(map.path, disparity);
  if (!stats) return stats.error();
  if (WillRepair(options.map, map)) {
    stats->min = std::max(stats->min - kRepairReach, -STARFOCUS_MAX_DISPARITY);
    stats->max = std::min(stats->max + kRepairReach, STARFOCUS_MAX_DISPARITY);
  }
  TellNotes(map);
  Error error = FindKeys(frame, map.path, disparity, video);
  if (!error && is_first) {
    video->stats = *stats;
    error = PlanApertures(options, map, plan, video);
    const DefaultFocus focus = FindDefaultFocus(map);
    if (!error) error = ChooseFirstFocus(video->stream.where(), focus, disparity, plan, video);
  }
  video->stats.min = std::min(video->stats.min, stats->min);
  video->stats.max = std::max(video->stats.max, stats->max);
  return error;
}

// Measures the maps of a stream.
Error ScanStream(const VideoOptions& options, LensPlan* plan, Video* video) {
  video->width = video->stream.header().width;
  video->height = video->stream.header().height;
  video->views = {{0, 0}};
  const Positions& wanted = plan->options.views;
  if (wanted.size() > 1) {
    return Error::Usage("--views", "1, because a stream has one view",
                        std::to_string(wanted.size()) + " views");
  }
  if (Error error = CheckRenderer(video->stream.where(), *plan, video->views)) return error;
  return video->stream.Survey([&](size_t frame, const Capture& map) {
    return AddMap(options, frame, map, plan, video);
  });
}

// Finds all frames or maps, and fits the lens to them.
Error Scan(const VideoOptions& options, LensPlan* plan, Video* video) {
  Error error = video->is_stream ? ScanStream(options, plan, video)
                                 : ScanFiles(options, plan, video);
  if (error) return error;
  if (!video->focus_keys.empty()) {
    plan->focus_option = "--focus-keys";
    plan->foci.clear();
    for (const FocusKey& key : video->focus_keys) plan->foci.push_back(key.disparity);
  }
  if (Error failed = ChooseBlur(video->stats, plan).MoveTo(&video->max_blur)) return failed;
  TellAperture(video->first(), plan->aperture);
  TellBlurred(video->first(), video->stats, SharpRadius(video->width, video->height), *plan);
  return {};
}

// Stage: reads a frame with its map.
Result<bool> Read(const VideoOptions& options, Video* video, ClipFrame* frame) {
  const size_t index = frame->index;
  Capture& capture = frame->capture;
  if (video->is_stream) {
    frame->where = video->stream.where() + ", frame " + std::to_string(index);
    frame->picture = NumberedPicture(index);
    return video->stream.Next(&capture);
  }
  if (index == video->frames.size()) return false;
  const FrameFiles& files = video->frames[index];
  frame->where = video->sources[index].path;
  frame->picture = video->sources[index].picture;
  Error error = LoadLightField(files.folder, video->views).MoveTo(&capture.light_field);
  if (error) return error;
  capture.light_field.is_linear = files.is_linear;
  capture.metadata.icc = files.icc;
  capture.metadata.colours = files.colours;
  if (Error wrong = CheckSize(frame->where, capture.light_field.disparity, *video)) return wrong;
  error = Prepare(options, files.where, &capture.light_field.disparity).error();
  if (error) return error;
  return true;
}

// Stage: fits the map of a frame of a stream to the frame, and repairs it. Maps of files have been
// repaired when the files were opened.
Result<bool> Repair(const VideoOptions& options, const LensPlan& plan, ClipFrame* frame) {
  Capture& capture = frame->capture;
  Error error = LoadInput({}, plan.options.threads, &capture);
  if (!error) error = CareForMap(options.map, plan.options.threads, &capture);
  if (!error) {
    error = Prepare(options, frame->where, &capture.light_field.disparity).error();
  }
  if (error) return error;
  return true;
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
    LightField now = std::move(frame->capture.light_field);
    const EngineTask task = TaskOf(frame->index, now);
    if (Error error = frame->index == 0 ? run_.Start(frame->where, task) : Error()) return error;
    // The engine compares pictures in RGB that have the same lens.
    const bool is_rgb = now.planar.samples.empty() && !task.planar_picture;
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
    picture_ = std::make_shared<const EngineResult>(std::move(*result));
    frame->result = picture_;
    return true;
  }

  const SeriesReport& report() const { return report_; }

 private:
  EngineTask TaskOf(size_t index, const LightField& light_field) const {
    EngineTask task = MakeTask(plan_, light_field, video_.stats, video_.max_blur, true);
    const Easing easing = options_.keys.easing;
    if (!video_.focus_keys.empty()) task.params.focus = FocusAt(video_.focus_keys, easing, index);
    if (!video_.aperture_keys.empty()) {
      task.params.aperture = RadiusAt(video_.aperture_keys, easing, index);
    }
    const PlanarImage& planar = light_field.planar;
    const bool is_planar = !planar.samples.empty();
    task.planar_picture = KindOfClip(options_.out) == ClipKind::kStream;
    if (is_planar || task.planar_picture) task.config.features |= STARFOCUS_FEATURE_IMAGES;
    if (planar.is_deep) task.config.features |= STARFOCUS_FEATURE_DEEP;
    task.planar.matrix = is_planar ? planar.matrix : HeaderOf(video_).matrix();
    task.planar.range = is_planar ? planar.range : HeaderOf(video_).range;
    task.planar.is_deep = planar.is_deep;
    return task;
  }

 public:
  // Returns the header of the stream of the frames.
  static Y4mHeader HeaderOf(const Video& video) {
    if (video.is_stream) return video.stream.header().Written();
    Y4mHeader header;
    header.width = video.width;
    header.height = video.height;
    return header;
  }

 private:
  const VideoOptions& options_;
  const LensPlan& plan_;
  const Video& video_;
  EngineRun run_;
  SeriesReport report_;
  LightField before_;
  std::shared_ptr<const EngineResult> picture_;  // of `before_`
  double focus_ = 0, aperture_ = 0;              // of `picture_`
};

struct Written {
  size_t frames = 0;
  bool is_closed = false;  // true: nobody reads the output any more
  std::string report;
};

// Runs all stages on all frames.
Result<Written> RefocusFrames(const VideoOptions& options, const LensPlan& plan, Video* video,
                              double start) {
  Written written;
  Refocusing refocusing(options, plan, *video);
  const std::unique_ptr<ClipOutput> output =
      MakeClipOutput(options.out, Refocusing::HeaderOf(*video));
  std::vector<Stage> stages;
  stages.emplace_back([&](ClipFrame* frame) { return Read(options, video, frame); });
  if (video->is_stream) {
    stages.emplace_back([&](ClipFrame* frame) { return Repair(options, plan, frame); });
  }
  // A stage that stabilises the maps belongs here: it gets the frames in order, with the centre view
  // and the map in frame->capture.light_field.
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

// Finds the inputs: a stream and its maps, or the files of the frames.
Error FindInput(const VideoOptions& options, Video* video) {
  video->is_stream = IsStream(options.inputs);
  if (video->is_stream) return video->stream.Open(options.inputs[0], options.input);
  return FindFrames(options.inputs, options.input, options.out).MoveTo(&video->sources);
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
  if (!error) error = Scan(options, &*plan, &video);
  if (error) return error;
  const Result<Written> written = RefocusFrames(options, *plan, &video, start);
  if (!written) return written.error();
  if (written->is_closed) return {};
  if (!options.report.empty()) error = WriteText(options.report, written->report);
  if (error) return error;
  if (video.is_stream) video.stream.TellEnd();
  TellLine(OutputName(options.out) + ": " + std::to_string(written->frames) +
           (written->frames == 1 ? " picture, " : " pictures, ") + LensText(*plan));
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
  AddLensKeyOptions(&command, &options->keys);
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
