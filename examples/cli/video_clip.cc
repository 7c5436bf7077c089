// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/video_clip.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "platform/light_field.h"
#include "platform/text.h"

namespace starfocus {

std::string NumberedPicture(size_t frame) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%04zu.png", frame);
  return name;
}

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

Error FindInput(const VideoOptions& options, Video* video) {
  video->is_stream = IsStream(options.inputs);
  if (video->is_stream) return video->stream.Open(options.inputs[0], options.input);
  return FindFrames(options.inputs, options.input, options.out).MoveTo(&video->sources);
}

namespace {

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

// Returns true if the maps of a video are stabilised: those that are repaired by default, and
// others if an option asks for it.
bool WillStabilise(const VideoOptions& options, const Capture& capture) {
  const bool is_default = capture.care == MapCare::kRepair && !options.map.no_repair;
  return options.stabilise || (is_default && !options.no_stabilise);
}

// Stabilises the map of the next frame, if the maps of the video are stabilised.
Error StabiliseMap(const VideoOptions& options, const std::string& where, int threads,
                   DisparityRange range, Capture* capture, Video* video) {
  if (!WillStabilise(options, *capture)) return {};
  if (video->stabiliser == nullptr) {
    video->stabiliser = std::make_unique<MapStabiliser>(threads, range);
  }
  return video->stabiliser->Stabilise(where, &capture->light_field, nullptr);
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
  const int threads = plan->options.threads;
  FrameFolders::Change stabilise;
  if (WillStabilise(options, *capture)) {
    stabilise = [&](Capture* loaded) {
      if (!is_first) {
        Error error = CheckSize(source.path, loaded->light_field.disparity, *video);
        if (error) return error;
      }
      return StabiliseMap(options, source.path, threads,
                          {-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY}, loaded, video);
    };
  }
  Result<Frame> frame = video->converted.Open(
      options.map, is_first ? plan->options.views : video->views, threads, stabilise, &*capture);
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
  return video->stream.Survey(
      [&](size_t frame, const Capture& map) { return AddMap(options, frame, map, plan, video); });
}

}  // namespace

Error ScanVideo(const VideoOptions& options, LensPlan* plan, Video* video) {
  Error error =
      video->is_stream ? ScanStream(options, plan, video) : ScanFiles(options, plan, video);
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

Result<bool> ReadFrame(const VideoOptions& options, Video* video, ClipFrame* frame) {
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

Result<bool> FitFrame(const VideoOptions& options, const LensPlan& plan, Video* video,
                      ClipFrame* frame) {
  Capture& capture = frame->capture;
  const int threads = plan.options.threads;
  const DisparityRange range = {static_cast<float>(video->stats.min),
                                static_cast<float>(video->stats.max)};
  Error error = LoadInput({}, threads, &capture);
  if (!error) error = StabiliseMap(options, frame->where, threads, range, &capture, video);
  if (error) return error;
  return true;
}

Result<bool> RepairFrame(const VideoOptions& options, const LensPlan& plan, ClipFrame* frame) {
  Capture& capture = frame->capture;
  Error error = CareForMap(options.map, plan.options.threads, &capture);
  if (!error) {
    error = Prepare(options, frame->where, &capture.light_field.disparity).error();
  }
  if (error) return error;
  return true;
}

}  // namespace starfocus
