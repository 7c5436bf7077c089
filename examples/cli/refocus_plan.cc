// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "examples/cli/engine_run.h"
#include "examples/cli/estimate_run.h"
#include "examples/cli/input.h"
#include "examples/command_line/options.h"
#include "platform/clock.h"
#include "platform/file.h"
#include "starfocus/pool.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

namespace {

std::string FirstInvalid(const FloatMap& map, int64_t count) {
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (std::isfinite(map.at(x, y))) continue;
      return std::to_string(count) + " other values, the first at " + std::to_string(x) + "," +
             std::to_string(y) + " (--fill-invalid replaces them)";
    }
  }
  return "";
}

// Parses NEAR,FAR.
std::string ReadFocusRange(const std::string& text, std::optional<FocusBand>* range) {
  const std::vector<double> ends = ReadNumbers(text, ',');
  if (ends.size() != 2 || ends[0] < ends[1] || ends[0] > STARFOCUS_MAX_FOCUS ||
      ends[1] < -STARFOCUS_MAX_FOCUS) {
    return "NEAR,FAR, disparities from -" + Short(STARFOCUS_MAX_FOCUS) + " to " +
           Short(STARFOCUS_MAX_FOCUS) + " with NEAR at least FAR";
  }
  *range = {ends[1], ends[0]};
  return "";
}

// Adds the options of the lens: its focus and the shape of its aperture.
void AddOpticsOptions(Command* command, LensOptions* options) {
  AddOptions(
      {
          {"--focus", "D",
           "Disparity in focus, in pixels per unit of u, from -1000000 to 1000000; "
           "default: the subject of the matte if the photo has no depth, otherwise the subject in "
           "the photo's EXIF, the focus stored in the file, the subject of the matte, or the "
           "nearest large surface near the centre",
           Number(&options->focus)},
          {"--focus-at", "X,Y",
           "Pixel whose surface is in focus, counted from 0,0 at the top left; the focus "
           "is the median disparity of this surface; default: see --focus",
           Pair(',', &options->focus_at)},
          {"--focus-range", "NEAR,FAR",
           "Disparities between which everything is sharp, in the unit of --focus, NEAR at "
           "least FAR; blur grows with the distance from this range; default: a single focus",
           Target([range = &options->focus_range](const std::string& text) {
             return ReadFocusRange(text, range);
           })},
      },
      command);
  AddApertureOptions(command, &options->aperture);
  AddShapeOptions(command, &options->shape);
}

// Returns the disparity at pixel (x, y) of the picture after filling unknown values around this
// pixel. Returns nullopt if no value around this pixel is known.
std::optional<double> FocusAround(const FloatMap& map, int x, int y) {
  // Number of pixels to read on each side of pixel (x, y). starfocus_focus_at reads fewer pixels.
  constexpr int kAround = 16;
  const int left = std::max(0, x - kAround), top = std::max(0, y - kAround);
  FloatMap part;
  part.width = std::min(map.width, x + kAround + 1) - left;
  part.height = std::min(map.height, y + kAround + 1) - top;
  for (int row = top; row < top + part.height; ++row) {
    for (int column = left; column < left + part.width; ++column) {
      part.values.push_back(map.at(column, row));
    }
  }
  const starfocus_depth_map depth = EngineMap(part);
  double focus = 0;
  if (starfocus_fill_disparity(part.values.data(), part.stride(), part.width, part.height,
                               nullptr) != STARFOCUS_OK ||
      starfocus_focus_at(&depth, part.width, part.height, x - left, y - top, &focus, nullptr) !=
          STARFOCUS_OK) {
    return {};
  }
  return focus;
}

// Sets the focus to the middle of a range, and its extent to the ends of the range.
void UseRange(const FocusBand& range, LensPlan* plan) {
  const double focus = 0.5 * (range.near + range.far);
  plan->focus_option = "--focus-range";
  plan->foci = {focus};
  plan->lens.focus_nearer = range.near - focus;
  plan->lens.focus_farther = focus - range.far;
}

// Adds the options that trade time against error.
void AddTuningOptions(Command* command, LensOptions* options) {
  AddOptions(
      {
          {"--superblock", "32|64|128|256", "Side of a superblock in pixels; default: 128",
           Choice<int>({{"32", 32}, {"64", 64}, {"128", 128}, {"256", 256}}, &options->superblock)},
          {"--renderer", "slices|line-scan",
           "slices renders a few views from slices of the scene; line-scan renders the "
           "paper's views line by line and needs a star of views; default: slices, but "
           "line-scan for --mode frame with 5 or more views",
           Choice<starfocus_renderer>(
               {{"slices", STARFOCUS_RENDERER_SLICES}, {"line-scan", STARFOCUS_RENDERER_LINE_SCAN}},
               &options->renderer)},
          {"--n-scale", "X",
           "Factor for the number of views along the radius, 0.5 to 2; smaller is faster, "
           "larger is more accurate",
           Number(STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE,
                  "a factor from " + Short(STARFOCUS_MIN_N_SCALE) + " to " +
                      Short(STARFOCUS_MAX_N_SCALE),
                  &options->n_scale),
           Use::kDefault},
          {"--max-layer", "0|1|2",
           "Largest layer of a block, 0 to 2; layer L is computed at 1/2^L of the size",
           Whole(0, STARFOCUS_LAYERS - 1, &options->max_layer), Use::kDefault},
          {"--deblocking", "N",
           "Largest step between layers that is smoothed, in grey levels, 0 to 255; 0 "
           "turns deblocking off",
           Whole(0, 255, &options->deblocking), Use::kDefault},
          {"--timing", "FILE",
           "JSON file of timing coefficients, as written by starfocus-lab calibrate; "
           "default: built-in coefficients",
           &options->timing},
      },
      command);
}

}  // namespace

void AddApertureOptions(Command* command, ApertureOptions* options) {
  AddOptions(
      {
          {"--aperture", "U",
           "Radius of the aperture, above 0 and at most 1; radius 1 reaches view (1, 0); "
           "default: 1, or f/1.8 for a photo, and less if the blur exceeds 128 pixels",
           Number(std::numeric_limits<double>::min(), 1, "an aperture above 0 and at most 1",
                  &options->aperture)},
          {"--f-stop", "N",
           "F-stop of the lens, at least --widest; the radius of the aperture is --widest "
           "/ N; default: see --aperture",
           FStop(&options->f_stop)},
          {"--widest", "W",
           "F-stop of an aperture of radius 1, above 0: the focal length divided by twice "
           "the distance from the centre to view (1, 0); default: the value stored in the "
           "input, otherwise 1",
           FStop(&options->widest)},
          {"--strength", "S",
           "Percentage of the aperture, 0 to 100; 0 keeps the centre view, whose light is rounded "
           "to 15 bits if codes have more than 8",
           Number(0, 100, "a percentage from 0 to 100", &options->strength), Use::kOptional,
           nullptr, "100"},
      },
      command);
}

void AddLensOptions(Command* command, LensOptions* options) {
  AddOpticsOptions(command, options);
  AddOptions(
      {
          {"--mode", "block|frame|benchmark|blur",
           "block gives each block its own number of views; frame uses one number for the "
           "whole picture; benchmark is the reference with twice as many views as the "
           "blur can show; blur blurs the centre view alone, looks like a quick preview "
           "and takes about ten times as long as block",
           Choice<starfocus_mode>({{"block", STARFOCUS_MODE_BLOCK},
                                   {"frame", STARFOCUS_MODE_FRAME},
                                   {"benchmark", STARFOCUS_MODE_BENCHMARK},
                                   {"blur", STARFOCUS_MODE_BLUR}},
                                  &options->mode),
           Use::kDefault},
      },
      command);
  AddOptions(
      {
          {"--transfer", "srgb|none",
           "Meaning of the pixel values: srgb values are converted to light before they "
           "are averaged; none averages the values themselves; default: srgb, or none for a photo "
           "whose file describes its values as linear light",
           Transfer(&options->transfer)},
          {"--highlights", "X", "Brightness of clipped lamps as a multiple of white, 1 to 64",
           Number(1, STARFOCUS_MAX_HIGHLIGHTS,
                  "a factor from 1 to " + Short(STARFOCUS_MAX_HIGHLIGHTS), &options->highlights),
           Use::kDefault},
          {"--views", "17|9|5|1|U,V:U,V",
           "Views to use: the star of 17, 9, 5 or 1 views, or positions U,V:U,V from -1 "
           "to 1 that begin with 0,0; default: all views of the input",
           Views(&options->views)},
          {"--threads", "N", kThreadsHelp, Threads(&options->threads)},
      },
      command);
  AddTuningOptions(command, options);
}

Result<LensPlan> PlanLens(const LensOptions& options) {
  if (options.focus && options.focus_at) {
    return Error::Usage("--focus", "either --focus D or --focus-at X,Y", "both");
  }
  if (options.focus_range && (options.focus || options.focus_at)) {
    const std::string other = options.focus ? "--focus" : "--focus-at";
    return Error::Usage("--focus-range", "either --focus-range or " + other, "both");
  }
  LensPlan plan;
  plan.options = options;
  if (options.threads == 0) plan.options.threads = starfocus_pool_cores();
  if (options.focus_at) {
    UseFocus({true, options.focus_at->x, options.focus_at->y, 0, ""}, &plan);
  } else if (options.focus) {
    UseFocus({false, 0, 0, *options.focus, ""}, &plan);
  }
  if (Error error = ParseShape(options.shape).MoveTo(&plan.lens)) return error;
  if (options.focus_range) UseRange(*options.focus_range, &plan);
  if (plan.lens.shape == STARFOCUS_SHAPE_POLYGON || plan.lens.cats_eye > 0) {
    plan.config.features |= STARFOCUS_FEATURE_SHAPES;
  }
  if (options.timing.empty()) return plan;
  if (Error error = ReadTiming(options.timing).MoveTo(&plan.config.tuning.timing)) return error;
  return plan;
}

void UseFocus(const DefaultFocus& focus, LensPlan* plan) {
  plan->focus_option = focus.at_pixel ? "--focus-at" : "--focus";
  plan->x = focus.x;
  plan->y = focus.y;
  if (!focus.at_pixel) plan->foci = {focus.disparity};
}

Error CheckRenderer(const std::string& where, const LensPlan& plan, const Positions& views) {
  if (plan.options.renderer != STARFOCUS_RENDERER_LINE_SCAN ||
      plan.options.mode == STARFOCUS_MODE_BLUR || AreStar(views)) {
    return {};
  }
  return Error::Usage("--renderer", "slices, because line-scan needs a star of 1, 5, 9 or 17 views",
                      "line-scan for the " + std::to_string(views.size()) + " views of " + where);
}

Result<starfocus_disparity_stats> PrepareDisparity(const std::string& where, const FloatMap& map,
                                                   bool may_have_holes) {
  const starfocus_disparity_stats stats = MeasureDisparity(map);
  if (may_have_holes && stats.invalid == int64_t{map.width} * map.height) {
    return Expected(where, "a map with finite disparities", "none");
  }
  if (!may_have_holes && stats.invalid != 0) {
    return Expected(where, "finite disparities only", FirstInvalid(map, stats.invalid));
  }
  const double largest = std::max(std::fabs(double(stats.min)), std::fabs(double(stats.max)));
  if (largest <= STARFOCUS_MAX_DISPARITY) return stats;
  return Expected(where,
                  "disparities from -" + Short(STARFOCUS_MAX_DISPARITY) + " to " +
                      Short(STARFOCUS_MAX_DISPARITY),
                  Short(stats.min) + " to " + Short(stats.max));
}

namespace {

Error CheckPixel(const char* option, const Pixel& at, int width, int height) {
  if (at.x < width && at.y < height) return {};
  return Error::Usage(option,
                      "a pixel of the picture, up to " + std::to_string(width - 1) + "," +
                          std::to_string(height - 1),
                      std::to_string(at.x) + "," + std::to_string(at.y));
}

}  // namespace

Result<std::optional<double>> FocusOfPixel(const char* option, const Pixel& at, int width,
                                           int height, const FloatMap& map) {
  if (Error error = CheckPixel(option, at, width, height)) return error;
  return FocusAround(map, static_cast<int>(int64_t{at.x} * map.width / width),
                     static_cast<int>(int64_t{at.y} * map.height / height));
}

Error ChooseFocus(const FloatMap& map, LensPlan* plan) {
  if (!plan->foci.empty()) return {};
  double focus = 0;
  const Pixel at = {plan->x, plan->y};
  if (Error error = CheckPixel("--focus-at", at, map.width, map.height)) return error;
  // starfocus_focus_at cannot fail, because PrepareDisparity has checked the map.
  const starfocus_depth_map depth = EngineMap(map);
  starfocus_focus_at(&depth, map.width, map.height, plan->x, plan->y, &focus, nullptr);
  plan->foci = {focus};
  return {};
}

std::string FocusText(const LensPlan& plan) {
  const double first = plan.foci.front(), last = plan.foci.back();
  const double near = first + plan.lens.focus_nearer, far = first - plan.lens.focus_farther;
  if (plan.foci.size() > 1) {
    return std::to_string(plan.foci.size()) + " foci from disparity " + ThreeDigits(first) +
           " to " + ThreeDigits(last);
  }
  if (near > far) {
    return "focus from disparity " + ThreeDigits(near) + " to " + ThreeDigits(far);
  }
  if (plan.focus_option != "--focus-at") return "focus at disparity " + ThreeDigits(first);
  return "focus " + std::to_string(plan.x) + "," + std::to_string(plan.y) + " (disparity " +
         ThreeDigits(first) + ")";
}

std::string LensText(const LensPlan& plan) {
  return FocusText(plan) + ", " +
         (plan.aperture.radius > 0 ? "f/" + ThreeDigits(plan.aperture.widest / plan.aperture.radius)
                                   : "sharp everywhere");
}

void TellBlurred(const std::string& path, const starfocus_disparity_stats& stats, double sharp,
                 const LensPlan& plan) {
  const double least = plan.aperture.radius > 0 ? sharp / plan.aperture.radius : HUGE_VAL;
  for (const double focus : plan.foci) {
    if (focus - plan.lens.focus_farther - stats.max <= least &&
        stats.min - focus - plan.lens.focus_nearer <= least) {
      return;
    }
  }
  TellNote(path, "nothing is sharp with the " + FocusText(plan) +
                     ", because the disparities of the map are from " + ThreeDigits(stats.min) +
                     " to " + ThreeDigits(stats.max));
}

Error ForeseeBlur(const LightField& light_field, bool repaired, LensPlan* plan) {
  const FloatMap& map = light_field.disparity;
  const Image& picture = light_field.views[0];
  std::vector<double> foci = plan->foci;
  if (foci.empty()) {
    const Result<std::optional<double>> focus =
        FocusOfPixel("--focus-at", {plan->x, plan->y}, picture.width, picture.height, map);
    if (!focus || !*focus) return focus.error();
    foci = {**focus};
  }
  starfocus_disparity_stats stats = MeasureDisparity(map);
  // If no value is known, later processing of the map reports the error.
  if (stats.invalid == int64_t{map.width} * map.height) return {};
  if (repaired) {
    stats.min -= kRepairReach;
    stats.max += kRepairReach;
  }
  return FitAperture(FarthestFromFocus(stats, foci, plan->lens), &plan->aperture);
}

Result<double> ChooseBlur(const starfocus_disparity_stats& stats, LensPlan* plan) {
  for (const double focus : plan->foci) {
    if (std::fabs(focus) <= STARFOCUS_MAX_FOCUS) continue;
    return Error::Usage(
        plan->focus_option,
        "a disparity from -" + Short(STARFOCUS_MAX_FOCUS) + " to " + Short(STARFOCUS_MAX_FOCUS),
        Short(focus));
  }
  const double range = FarthestFromFocus(stats, plan->foci, plan->lens);
  if (Error error = FitAperture(range, &plan->aperture)) return error;
  return std::max(1.0, std::ceil(plan->aperture.radius * range));
}

EngineTask MakeTask(const LensPlan& plan, const LightField& light_field,
                    const starfocus_disparity_stats& stats, double max_blur, bool reported) {
  EngineTask task;
  task.light_field = &light_field;
  task.config = plan.config;
  task.config.width = light_field.width();
  task.config.height = light_field.height();
  ConfigureViews(light_field, &task.config);
  task.config.disparity_min = stats.min;
  task.config.disparity_max = stats.max;
  task.config.max_blur = max_blur;
  task.config.superblock = plan.options.superblock;
  task.config.tuning.line_scan = starfocus_line_scan_renderer();
  task.config.tuning.max_layer = plan.options.max_layer;
  task.config.tuning.deblocking = plan.options.deblocking;
  task.config.tuning.n_scale = plan.options.n_scale;
  const starfocus_transfer own =
      light_field.is_linear ? STARFOCUS_TRANSFER_NONE : STARFOCUS_TRANSFER_SRGB;
  task.config.transfer = plan.options.transfer.value_or(own);
  task.config.highlights = plan.options.highlights;
  static_cast<starfocus::Params&>(task.params) = plan.lens;
  task.params.study.mode = plan.options.mode;
  task.params.study.renderer = plan.options.renderer;
  task.params.focus = plan.foci[0];
  task.params.aperture = plan.aperture.radius;
  task.params.region = plan.region;
  if (reported) {
    task.observer.clock = [](void*) -> uint64_t { return ThreadNanoseconds(); };
  }
  task.threads = plan.options.threads;
  return task;
}

}  // namespace starfocus
