// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/refocus/refocus_plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "examples/cli/engine/timing_file.h"
#include "examples/cli/refocus/refocus_report.h"
#include "examples/command_line/options.h"
#include "platform/clock.h"
#include "platform/file.h"

namespace starfocus {
namespace {

Error ParseMode(const std::string& text, sf_mode* mode) {
  for (size_t i = 0; i < std::size(kModeNames); ++i) {
    if (text != kModeNames[i]) continue;
    *mode = static_cast<sf_mode>(i);
    return "";
  }
  return Error::Usage("--mode", "block, frame, benchmark or blur", "'" + text + "'");
}

Error ParseRule(const std::string& text, sf_rule* rule) {
  if (text.empty()) return "";
  if (text != "paper" && text != "subaperture") {
    return Error::Usage("--rule", "paper or subaperture", "'" + text + "'");
  }
  *rule = text == "paper" ? SF_RULE_PAPER : SF_RULE_SUBAPERTURE;
  return "";
}

Error ParseLargestBlock(const std::string& text, int* side) {
  if (text.empty()) return "";
  const Error range = ParseWhole("--largest-block", text, 32, 256, side);
  if (range.empty() && (*side & (*side - 1)) == 0) return "";
  return Error::Usage("--largest-block", "32, 64, 128 or 256", "'" + text + "'");
}

// --f-stop and --widest; `known` is the input's widest.
Error ParseFStop(const LensOptions& options, double known, double* aperture) {
  double f_stop = 0, widest = known > 0 ? known : 1;
  Error error;
  if (!options.widest.empty()) error = ParseNumber("--widest", options.widest, &widest);
  if (error.empty() && widest <= 0) {
    error = Error::Usage("--widest", "an f-stop above 0", "'" + options.widest + "'");
  }
  if (error.empty()) error = ParseNumber("--f-stop", options.f_stop, &f_stop);
  if (!error.empty() || sf_aperture_of_f_stop(f_stop, widest, aperture) == SF_OK) return error;
  return Error::Usage("--f-stop", "an f-stop from the widest on, " + Short(widest),
                      "'" + options.f_stop + "'");
}

// Sets what block mode adds to the plan.
Error PlanBlocks(const LensOptions& options, LensPlan* plan) {
  Error error = ParseLargestBlock(options.largest_block, &plan->largest_block);
  if (!error.empty()) return error;
  error = ParseWhole("--max-layer", options.max_layer, 0, SF_LAYERS - 1, &plan->max_layer);
  if (error.empty()) {
    error = ParseWhole("--deblocking", options.deblocking, 0, 255, &plan->deblocking);
  }
  if (!error.empty()) return error;
  if (!options.timing.empty()) return ReadTiming(options.timing, &plan->timing);
  plan->timing = plan->config.timing;
  return "";
}

std::string FirstInvalid(const FloatMap& map, int64_t count) {
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (std::isfinite(map.at(x, y))) continue;
      return std::to_string(count) + " that are not, the first at " + std::to_string(x) + "," +
             std::to_string(y) + " (--fill-invalid replaces them)";
    }
  }
  return "";
}

// The lens: where it is focused, and its opening.
void AddOpticsOptions(CLI::App* command, LensOptions* options) {
  command->add_option("--focus", options->focus, "Disparity in focus");
  command->add_option("--focus-at", options->focus_at,
                      "X,Y: the disparity of what is at that pixel, the median of its surface "
                      "there");
  command->add_option("--aperture", options->aperture,
                      "Radius, above 0 up to 1; default: 1, of a photo that of f/1.8");
  command->add_option("--f-stop", options->f_stop,
                      "The same as an f-stop, from the widest on: radius --widest / N");
  command->add_option(
      "--widest", options->widest,
      "F-stop of radius 1: focal length over twice the distance of view (1, 0) from "
      "the centre; default: what the input knows of itself, else 1, for f-stops relative to that "
      "radius");
  command
      ->add_option("--strength", options->strength,
                   "0 to 100 percent of that radius; 0: the centre view to the byte")
      ->capture_default_str();
  AddShapeOptions(command, &options->shape);
}

}  // namespace

void AddLensOptions(CLI::App* command, LensOptions* options) {
  AddOpticsOptions(command, options);
  command
      ->add_option("--mode", options->mode,
                   "In blocks of their own number of views, with one number for the whole frame, "
                   "as a benchmark of twice the views that blur can show, or by blurring the "
                   "centre view alone: this looks like a quick preview of the others but takes "
                   "about ten times as long as block")
      ->type_name("block|frame|benchmark|blur")
      ->capture_default_str();
  AddTransferOption(command,
                    "What codes of the pictures stand for: light coded as sRGB, which a lens adds, "
                    "or values to be averaged as they are",
                    &options->transfer);
  command
      ->add_option("--highlights", options->highlights,
                   "1 to 64: how many times white the lamps are that the pictures clip")
      ->capture_default_str();
  command->add_option(
      "--views", options->views,
      "17, 9, 5 or 1, or positions U,V:U,V, the first one 0,0; default: all of the folder");
  command->add_option("--threads", options->threads, "1 to 64")->capture_default_str();
  command->add_option("--largest-block", options->largest_block,
                      "32, 64, 128 or 256; default: 64, for pictures from 1536 pixels wide on 128");
  command
      ->add_option(
          "--rule", options->rule,
          "How many views a blur needs, and whether they are rendered line by line (paper) "
          "or show slices; default: paper in frame mode of 5 or more views, else subaperture")
      ->type_name("paper|subaperture");
  command
      ->add_option("--n-scale", options->n_scale,
                   "0.5 to 2: multiplies the rule's views along the radius; fewer are faster, more "
                   "closer to the benchmark")
      ->capture_default_str();
  command->add_option("--max-layer", options->max_layer, "0, 1 or 2: may subsample by 2^L")
      ->capture_default_str();
  command
      ->add_option("--deblocking", options->deblocking,
                   "0 to 255 grey levels: the largest step smoothed between layers; 0: off")
      ->capture_default_str();
  command
      ->add_option("--timing", options->timing,
                   "JSON file that starfocus calibrate wrote; default: built in")
      ->type_name("FILE");
}

Error PlanLens(const LensOptions& options, LensPlan* plan) {
  sf_config_init(&plan->config);
  Error error = ParseShape(options.shape, &plan->config);
  if (error.empty()) {
    error = ParseWhole("--threads", options.threads, 1, SF_MAX_WORKERS, &plan->threads);
  }
  if (error.empty() && !options.views.empty()) {
    error = ParseViews("--views", options.views, &plan->views);
  }
  if (error.empty()) error = ParseMode(options.mode, &plan->mode);
  if (error.empty()) error = ParseRule(options.rule, &plan->rule);
  if (error.empty()) error = ParseTransfer("--transfer", options.transfer, &plan->transfer);
  if (error.empty()) {
    error = ParseHighlights("--highlights", options.highlights, &plan->highlights);
  }
  if (error.empty()) error = ParseScale("--n-scale", options.n_scale, &plan->n_scale);
  return error.empty() ? PlanBlocks(options, plan) : error;
}

Error PlanAperture(const LensOptions& options, const Capture& capture, LensPlan* plan) {
  if (!options.aperture.empty() && !options.f_stop.empty()) {
    return Error::Usage("--f-stop", "either --aperture U or --f-stop N", "both");
  }
  if (!options.widest.empty() && options.f_stop.empty()) {
    return Error::Usage("--widest", "--f-stop N beside it", "none");
  }
  Error error;
  if (capture.f_stop > 0) plan->aperture = capture.widest / capture.f_stop;
  if (!options.aperture.empty()) {
    error = ParseAperture("--aperture", options.aperture, &plan->aperture);
  }
  if (!options.f_stop.empty()) error = ParseFStop(options, capture.widest, &plan->aperture);
  double strength = 0;
  if (error.empty()) error = ParsePercentage("--strength", options.strength, &strength);
  plan->aperture *= strength / 100;
  return error;
}

Error PlanFocus(const LensOptions& options, LensPlan* plan) {
  if (options.focus.empty() == options.focus_at.empty()) {
    return Error::Usage("--focus", "either --focus D or --focus-at X,Y",
                        options.focus.empty() ? "neither" : "both");
  }
  if (options.focus.empty()) {
    plan->focus_option = "--focus-at";
    return ParsePair("--focus-at", options.focus_at, ',', &plan->x, &plan->y);
  }
  plan->focus_option = "--focus";
  plan->foci.resize(1);
  return ParseNumber("--focus", options.focus, &plan->foci[0]);
}

Error CheckRule(const std::string& where, const LensPlan& plan, const Positions& views) {
  if (plan.rule != SF_RULE_PAPER || plan.mode == SF_MODE_BLUR || AreStar(views)) {
    return "";
  }
  return Error::Usage("--rule", "subaperture, as paper needs a star of 1, 5, 9 or 17 views",
                      "paper for the " + std::to_string(views.size()) + " views of " + where);
}

std::string PrepareDisparity(const std::string& where, const FloatMap& map,
                             sf_disparity_stats* stats) {
  const sf_status status = sf_measure_disparity(
      map.values.data(), sizeof(float) * size_t(map.width), map.width, map.height, stats);
  if (status != SF_OK) return Expected(where, "a disparity map", sf_status_string(status));
  if (stats->invalid != 0) {
    return Expected(where, "finite disparities", FirstInvalid(map, stats->invalid));
  }
  const double largest = std::max(std::fabs(double(stats->min)), std::fabs(double(stats->max)));
  if (largest <= SF_MAX_DISPARITY) return "";
  return Expected(where, "disparities within +-" + Short(SF_MAX_DISPARITY),
                  Short(stats->min) + " to " + Short(stats->max));
}

Error ChooseFocus(const FloatMap& map, LensPlan* plan) {
  if (!plan->foci.empty()) return "";
  double focus = 0;
  // The map is a good one (PrepareDisparity): only the position may be wrong.
  if (sf_focus_at(map.values.data(), sizeof(float) * size_t(map.width), map.width, map.height,
                  plan->x, plan->y, &focus) != SF_OK) {
    return Error::Usage("--focus-at",
                        "a pixel of the picture, up to " + std::to_string(map.width - 1) + "," +
                            std::to_string(map.height - 1),
                        std::to_string(plan->x) + "," + std::to_string(plan->y));
  }
  plan->foci = {focus};
  return "";
}

Error ChooseBlur(const LensPlan& plan, const sf_disparity_stats& stats, double* max_blur) {
  double focus = plan.foci[0], range = 0;
  for (const double f : plan.foci) {
    const double r = std::max(std::fabs(stats.min - f), std::fabs(stats.max - f));
    if (r <= range) continue;
    range = r;
    focus = f;
  }
  const double needed = plan.aperture * range;
  *max_blur = std::max(1.0, std::ceil(needed));
  if (needed <= SF_MAX_BLUR && std::fabs(focus) <= SF_MAX_FOCUS) return "";
  return Error::Usage(plan.focus_option, "blur radii up to " + Short(SF_MAX_BLUR) + " pixels",
                      Short(needed) + " (aperture " + Short(plan.aperture) + ", focus " +
                          Short(focus) + ", disparities " + Short(stats.min) + " to " +
                          Short(stats.max) + ")");
}

EngineTask MakeTask(const LensPlan& plan, const LightField& light_field,
                    const sf_disparity_stats& stats, double max_blur, bool reported) {
  EngineTask task;
  task.light_field = &light_field;
  task.config = plan.config;
  task.config.width = light_field.width();
  task.config.height = light_field.height();
  ConfigureViews(light_field, &task.config);
  task.config.disparity_min = stats.min;
  task.config.disparity_max = stats.max;
  task.config.max_blur = max_blur;
  task.config.largest_block = plan.largest_block;
  task.config.max_layer = plan.max_layer;
  task.config.deblocking = plan.deblocking;
  task.config.timing = plan.timing;
  task.config.n_scale = plan.n_scale;
  task.config.transfer = plan.transfer;
  task.config.highlights = static_cast<float>(plan.highlights);
  sf_params_init(&task.params);
  task.params.mode = plan.mode;
  task.params.rule = plan.rule;
  task.params.focus = plan.foci[0];
  task.params.aperture = plan.aperture;
  task.params.region = plan.region;
  if (reported) task.params.clock = ThreadNanoseconds;
  task.threads = plan.threads;
  return task;
}

}  // namespace starfocus
