// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/video_clip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "platform/light_field.h"
#include "platform/pfm.h"
#include "platform/progress.h"
#include "platform/text.h"

namespace starfocus {

std::string NumberedPicture(size_t frame) {
  char name[40];
  std::snprintf(name, sizeof name, "frame_%04zu.png", frame);
  return name;
}

bool HasDeepCodes(const LightField& light_field) {
  if (light_field.deep.empty()) return false;
  const DeepImage& centre = light_field.deep[0];
  return centre.bits > 8 && centre.channels == 3 && !centre.is_half &&
         centre.transfer == STARFOCUS_TRANSFER_SRGB;
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
  return FindFrames(options.inputs, options.input, options.out, options.lens.highlights > 1)
      .MoveTo(&video->sources);
}

namespace {

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
  const bool is_only = video->count() == 0;  // the map of all frames
  for (size_t k = 0; k < video->focus_keys.size(); ++k) {
    const FocusKey& key = video->focus_keys[k];
    if (!key.at || (key.frame != frame && !is_only)) continue;
    const Result<std::optional<double>> focus =
        FocusOfPixel("--focus-keys", *key.at, video->width, video->height, map);
    if (!focus) return focus.error();
    if (!*focus) return Expected(where, "known disparities around " + key.text, "none");
    SetDisparity(**focus, k, &video->focus_keys);
  }
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
                   DisparityRange range, Capture* capture,
                   std::unique_ptr<MapStabiliser>* stabiliser) {
  if (!WillStabilise(options, *capture)) return {};
  if (*stabiliser == nullptr) *stabiliser = std::make_unique<MapStabiliser>(threads, range);
  return (*stabiliser)->Stabilise(where, &capture->light_field, nullptr);
}

// Opens a frame, whose depth map is interpreted by the figures of the clip, or by its own figures
// if `clip` is null. Frames of a stream have no pixels.
Result<Capture> OpenFrame(const VideoOptions& options, size_t frame, const MapSurvey* clip,
                          Video* video) {
  if (video->is_stream) return video->stream.OpenMapOf(frame, clip);
  InputOptions one = OptionsOf(options.input, video->sources[frame]);
  one.kept = &video->computed;
  one.map.clip = clip;
  return ReadInput(one);
}

// Loads the views and the map of a frame. A map that is estimated is kept in a temporary file.
Error LoadFrame(size_t frame, const Positions& views, int threads, Video* video, Capture* capture) {
  if (!capture->map_path.empty()) return LoadInput(views, threads, capture);
  const std::string kept = video->estimates.path() + "/" + std::to_string(frame) + ".pfm";
  std::error_code ignored;
  if (!video->estimates.path().empty() && std::filesystem::exists(kept, ignored)) {
    Error error = LoadCapture(views, capture);
    return error ? error : LoadMap(kept, &capture->light_field);
  }
  Error error = LoadInput(views, threads, capture);
  if (!error && video->estimates.path().empty()) error = video->estimates.Create();
  if (error) return error;
  return WritePfm(video->estimates.path() + "/" + std::to_string(frame) + ".pfm",
                  capture->light_field.disparity);
}

// Opens and measures all frames before the first frame is refocused.
class Scan {
 public:
  Scan(const VideoOptions& options, LensPlan* plan, Video* video)
      : options_(options), plan_(*plan), video_(*video) {}

  Error Run() {
    const size_t views = plan_.options.views.size();
    if (video_.is_stream && views > 1) {
      return Error::Usage("--views", "1, because a stream has one view",
                          std::to_string(views) + " views");
    }
    const size_t count = std::max<size_t>(video_.count(), 1);
    Progress progress("measuring depth", 2 * static_cast<int64_t>(count));
    const auto open = [&](size_t frame, const MapSurvey* clip) {
      progress.Step();
      return OpenFrame(options_, frame, clip, &video_);
    };
    frames_ahead_ = FramesAhead();
    Error error = SurveyClip(count, open).MoveTo(&video_.survey);
    for (size_t frame = 0; frame < count && !error; ++frame) {
      Result<Capture> capture = open(frame, &video_.survey);
      error = capture ? Add(frame, &*capture) : capture.error();
    }
    return error;
  }

 private:
  // Returns the number of frames whose maps are stabilised already here, because the focus depends
  // on the last of them. Streams are read only once, so that their focus depends on maps as they
  // come.
  size_t FramesAhead() const {
    if (video_.is_stream) return 0;
    if (video_.focus_keys.empty()) return plan_.foci.empty() ? 1 : 0;
    size_t frames = 0;
    for (const FocusKey& key : video_.focus_keys) {
      if (key.at) frames = key.frame + 1;
    }
    return frames;
  }

  // Adds a frame. The first frame sets the size, the views, the aperture and, unless there are
  // keys, the focus of all frames.
  Error Add(size_t frame, Capture* capture) {
    const bool is_first = frame == 0;
    TellNotes(*capture);
    Error error = is_first ? TakeViews(*capture)
                           : SelectViewFiles(capture->path, capture->files, video_.views).error();
    if (!error && is_first) error = PlanApertures(options_, *capture, &plan_, &video_);
    if (!error && !capture->photo) error = Load(frame, capture);
    if (error) return error;
    const LightField& light_field = capture->light_field;
    if (is_first) {
      video_.width = light_field.views[0].width;
      video_.height = light_field.views[0].height;
      video_.is_linear = light_field.is_linear;
      video_.is_deep = HasDeepCodes(light_field) && plan_.options.highlights <= 1;
      // The default focus does not depend on the repair of a map, as in the command refocus.
      if (video_.focus_keys.empty() && plan_.focus_option.empty()) {
        const DefaultFocus focus = FindDefaultFocus(*capture);
        TellFocus(video_.first(), focus);
        UseFocus(focus, &plan_);
      }
    }
    if (light_field.is_linear != video_.is_linear) {
      return Expected(capture->path, "light coded as in the first frame",
                      light_field.is_linear ? "linear light" : "codes that are not linear");
    }
    error = AddRange(is_first, *capture);
    if (!error && frame < frames_ahead_) error = FinishMap(frame, capture);
    if (!error) error = FindKeys(frame, capture->path, light_field.disparity, &video_);
    if (!error && is_first) error = ChooseFirstFocus(capture->path, light_field.disparity);
    return error;
  }

  // Sets the views of all frames.
  Error TakeViews(const Capture& first) {
    video_.views = plan_.options.views;
    if (Error error = CheckViews(video_.views, first)) return error;
    if (video_.views.empty()) {
      for (const ViewFile& file : first.files) video_.views.push_back(file.position);
    }
    return CheckRenderer(video_.first(), plan_, video_.views);
  }

  // Loads a frame with all its views, or only the centre view if this suffices.
  Error Load(size_t frame, Capture* capture) {
    const bool needs_views = capture->map_path.empty() || frame < frames_ahead_;
    const Positions views = needs_views ? video_.views : Positions{{0, 0}};
    return LoadFrame(frame, views, plan_.options.threads, &video_, capture);
  }

  // Adds the disparities of a map as it comes, and what a repair may add, to those of the video.
  Error AddRange(bool is_first, const Capture& capture) {
    const bool repairs = WillRepair(options_.map, capture);
    const bool fills = repairs || options_.map.fill || capture.care != MapCare::kNone ||
                       WillStabilise(options_, capture);
    Result<starfocus_disparity_stats> stats =
        PrepareDisparity(MapName(capture), capture.light_field.disparity, fills);
    if (!stats) return stats.error();
    DisparityRange& given = video_.given;
    given = {std::min(is_first ? INFINITY : given.min, float(stats->min)),
             std::max(is_first ? -INFINITY : given.max, float(stats->max))};
    if (repairs) {
      stats->min = std::max(stats->min - kRepairReach, -STARFOCUS_MAX_DISPARITY);
      stats->max = std::min(stats->max + kRepairReach, STARFOCUS_MAX_DISPARITY);
    }
    if (is_first) video_.stats = *stats;
    video_.stats.min = std::min(video_.stats.min, stats->min);
    video_.stats.max = std::max(video_.stats.max, stats->max);
    return {};
  }

  // Stabilises a map, and repairs it if the focus depends on it.
  Error FinishMap(size_t frame, Capture* capture) {
    const std::vector<FocusKey>& keys = video_.focus_keys;
    const int threads = plan_.options.threads;
    Error error = capture->photo ? Load(frame, capture) : Error();
    if (!error) {
      error =
          StabiliseMap(options_, capture->path, threads,
                       {-STARFOCUS_MAX_DISPARITY, STARFOCUS_MAX_DISPARITY}, capture, &stabiliser_);
    }
    const bool is_key = keys.empty() || std::any_of(keys.begin(), keys.end(), [&](auto& key) {
                          return key.frame == frame && key.at;
                        });
    return !error && is_key ? CareForMap(options_.map, threads, capture) : error;
  }

  // Sets the focus of all frames from the map of the first frame, unless it is known.
  Error ChooseFirstFocus(const std::string& path, const FloatMap& map) {
    if (!video_.focus_keys.empty() || !plan_.foci.empty()) return {};
    const Result<std::optional<double>> found =
        FocusOfPixel("--focus-at", {plan_.x, plan_.y}, video_.width, video_.height, map);
    if (!found) return found.error();
    if (!*found) return Expected(path, "known disparities around the focus", "none");
    plan_.foci = {**found};
    return {};
  }

  const VideoOptions& options_;
  LensPlan& plan_;
  Video& video_;
  size_t frames_ahead_ = 0;
  std::unique_ptr<MapStabiliser> stabiliser_;
};

}  // namespace

Error ScanVideo(const VideoOptions& options, LensPlan* plan, Video* video) {
  Error error = Scan(options, plan, video).Run();
  if (error) return error;
  if (!video->focus_keys.empty()) {
    plan->focus_option = "--focus-keys";
    plan->foci.clear();
    for (const FocusKey& key : video->focus_keys) plan->foci.push_back(key.disparity);
  }
  const size_t keys = plan->foci.size();
  if (video->tracks()) {
    // A subject may have any disparity.
    plan->foci.insert(plan->foci.end(), {video->stats.min, video->stats.max});
    if (video->width < 16 || video->height < 16) {
      return Error::Usage("--focus-keys", "frames of at least 16x16 pixels for track",
                          SizeText(video->width, video->height));
    }
  }
  if (Error failed = ChooseBlur(video->stats, plan).MoveTo(&video->max_blur)) return failed;
  plan->foci.resize(keys);
  TellAperture(video->first(), plan->aperture);
  TellBlurred(video->first(), video->stats, SharpRadius(video->width, video->height), *plan);
  return {};
}

Result<bool> ReadFrame(const VideoOptions& options, const LensPlan& plan, Video* video,
                       ClipFrame* frame) {
  const size_t index = frame->index;
  Capture* const capture = &frame->capture;
  if (video->is_stream) {
    frame->where = video->stream.where() + ", frame " + std::to_string(index);
    frame->picture = NumberedPicture(index);
    const Result<bool> has = video->stream.Next(video->survey, capture);
    if (!has || !*has) return has;
  } else {
    if (index == video->sources.size()) return false;
    frame->where = video->sources[index].path;
    frame->picture = video->sources[index].picture;
    Error error = OpenFrame(options, index, &video->survey, video).MoveTo(capture);
    if (error) return error;
  }
  Error error = LoadFrame(index, video->views, plan.options.threads, video, capture);
  if (error) return error;
  const LightField& light_field = capture->light_field;
  if (light_field.width() == video->width && light_field.height() == video->height) return true;
  return Expected(frame->where, SizeText(video->width, video->height) + " pixels as before",
                  SizeText(light_field.width(), light_field.height()));
}

Result<bool> StabiliseFrame(const VideoOptions& options, const LensPlan& plan, Video* video,
                            ClipFrame* frame) {
  const DisparityRange range = video->given;
  const int threads = plan.options.threads;
  LightField& light_field = frame->capture.light_field;
  const bool keeps_map = video->tracks() && !WillStabilise(options, frame->capture);
  Error error;
  if (keeps_map) {
    // Subjects are followed in stabilised maps, but the picture gets its map as it came.
    FloatMap map = light_field.disparity;
    std::vector<uint8_t> coverage = light_field.coverage;
    if (!video->stabiliser) video->stabiliser = std::make_unique<MapStabiliser>(threads, range);
    error = video->stabiliser->Stabilise(frame->where, &light_field, nullptr);
    light_field.disparity = std::move(map);
    light_field.coverage = std::move(coverage);
  } else {
    error =
        StabiliseMap(options, frame->where, threads, range, &frame->capture, &video->stabiliser);
  }
  std::vector<FocusKey>* const keys = &video->focus_keys;
  if (!error && video->tracks()) {
    error = FollowSubjects(frame->where, frame->index, video->stabiliser->get(), range,
                           keeps_map ? &light_field : nullptr, keys);
  }
  if (error) return error;
  if (!keys->empty()) frame->focus = FocusAt(*keys, options.keys.easing, frame->index);
  return true;
}

Result<bool> RepairFrame(const VideoOptions& options, const LensPlan& plan, ClipFrame* frame) {
  Capture& capture = frame->capture;
  Error error = CareForMap(options.map, plan.options.threads, &capture);
  if (!error) error = PrepareDisparity(frame->where, capture.light_field.disparity).error();
  if (error) return error;
  return true;
}

}  // namespace starfocus
