// starfocus refocus: the picture of a lens focused elsewhere.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <vector>

#include "commands.h"
#include "engine_run.h"
#include "options.h"
#include "partition_map.h"
#include "platform/clock.h"
#include "platform/image_io.h"
#include "refocus_report.h"
#include "timing_file.h"

namespace starfocus {
namespace {

struct Options {
  std::string folder, out, report, map, timing;
  std::string focus, focus_at, region, aperture = "1", mode = "block", rule, views, threads = "1";
  std::string largest_block = "64", max_layer = "2", deblocking = "35";
  bool stream = false, fill_invalid = false;
};

struct Plan {
  double focus = 0, aperture = 1;
  bool focus_at = false;
  int x = 0, y = 0;
  sf_region region = {};  // all 0: the whole picture
  sf_mode mode = SF_MODE_BLOCK;
  sf_rule rule = SF_RULE_DEFAULT;
  int views = 0;  // 0: all there are
  int threads = 1;
  int largest_block = 0, max_layer = 0, deblocking = 0;
  sf_timing timing = {};
};

std::string ParseMode(const std::string& text, sf_mode* mode) {
  for (size_t i = 0; i < std::size(kModeNames); ++i) {
    if (text != kModeNames[i]) continue;
    *mode = static_cast<sf_mode>(i);
    return "";
  }
  return Expected("--mode", "block, frame, benchmark or blur", "'" + text + "'");
}

std::string ParseRule(const std::string& text, sf_rule* rule) {
  if (text.empty()) return "";
  if (text != "paper" && text != "cells") {
    return Expected("--rule", "paper or cells", "'" + text + "'");
  }
  *rule = text == "paper" ? SF_RULE_PAPER : SF_RULE_CELLS;
  return "";
}

// Sets what block mode adds to the plan.
std::string PlanBlocks(const Options& options, Plan* plan) {
  int* const side = &plan->largest_block;
  const std::string range = ParseWhole("--largest-block", options.largest_block, 32, 256, side);
  if (!range.empty() || (*side & (*side - 1)) != 0) {
    return Expected("--largest-block", "32, 64, 128 or 256", "'" + options.largest_block + "'");
  }
  std::string error =
      ParseWhole("--max-layer", options.max_layer, 0, SF_LAYERS - 1, &plan->max_layer);
  if (error.empty()) {
    error = ParseWhole("--deblocking", options.deblocking, 0, 255, &plan->deblocking);
  }
  if (!error.empty()) return error;
  if (!options.timing.empty()) return ReadTiming(options.timing, &plan->timing);
  sf_config defaults;
  sf_config_init(&defaults);
  plan->timing = defaults.timing;
  return "";
}

std::string CheckOutputs(const Options& options) {
  std::string error = CheckImageOutput(options.out);
  if (error.empty() && !options.report.empty()) error = CheckOutputPath(options.report);
  if (error.empty() && !options.map.empty()) error = CheckImageOutput(options.map);
  if (error.empty() && options.map == options.out) {
    error = Expected("--map", "another file than --output", "'" + options.map + "' for both");
  }
  return error;
}

std::string PlanFocus(const Options& options, Plan* plan) {
  if (options.focus.empty() == options.focus_at.empty()) {
    return Expected("--focus", "either --focus D or --focus-at X,Y",
                    options.focus.empty() ? "neither" : "both");
  }
  plan->focus_at = options.focus.empty();
  if (plan->focus_at) return ParsePair("--focus-at", options.focus_at, ',', &plan->x, &plan->y);
  return ParseNumber("--focus", options.focus, &plan->focus);
}

std::string PlanRegion(const Options& options, Plan* plan) {
  if (options.stream) return Expected("--region", "whole pictures in memory", "--stream");
  return ParseRegion("--region", options.region, &plan->region);
}

// Everything that can be refused before a file is read.
std::string MakePlan(const Options& options, Plan* plan) {
  std::string error = CheckOutputs(options);
  if (error.empty()) error = PlanFocus(options, plan);
  if (error.empty()) error = ParseAperture("--aperture", options.aperture, &plan->aperture);
  if (error.empty()) {
    error = ParseWhole("--threads", options.threads, 1, SF_MAX_WORKERS, &plan->threads);
  }
  if (error.empty() && !options.views.empty()) {
    error = ParseViews("--views", options.views, &plan->views);
  }
  if (error.empty() && !options.region.empty()) error = PlanRegion(options, plan);
  if (error.empty()) error = ParseMode(options.mode, &plan->mode);
  if (error.empty()) error = ParseRule(options.rule, &plan->rule);
  return error.empty() ? PlanBlocks(options, plan) : error;
}

std::string Load(const Options& options, const Plan& plan, LightField* light_field) {
  if (plan.views != 0) {
    // A missing view of the set asked for is the option's fault when smaller sets are complete.
    int available = 0;
    const std::string error = CountViews(options.folder, &available);
    if (error.empty() && available < plan.views) {
      return Expected("--views",
                      "at most " + std::to_string(available) + ", the views in " + options.folder,
                      std::to_string(plan.views));
    }
  }
  return LoadLightField(options.folder, plan.views, light_field);
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

// Fills holes if asked to and measures the map.
std::string PrepareDisparity(const Options& options, FloatMap* map, sf_disparity_stats* stats) {
  const std::string path = DisparityPath(options.folder);
  const size_t stride = sizeof(float) * size_t(map->width);
  sf_status status = SF_OK;
  if (options.fill_invalid) {
    status = sf_fill_disparity(map->values.data(), stride, map->width, map->height);
  }
  if (status == SF_OK) {
    status = sf_measure_disparity(map->values.data(), stride, map->width, map->height, stats);
  }
  if (status != SF_OK) return Expected(path, "a disparity map", sf_status_string(status));
  if (stats->invalid != 0) {
    return Expected(path, "finite disparities", FirstInvalid(*map, stats->invalid));
  }
  const double largest = std::max(std::fabs(double(stats->min)), std::fabs(double(stats->max)));
  if (largest <= SF_MAX_DISPARITY) return "";
  return Expected(path, "disparities within +-" + Short(SF_MAX_DISPARITY),
                  Short(stats->min) + " to " + Short(stats->max));
}

std::string ChooseFocus(const FloatMap& map, Plan* plan) {
  if (!plan->focus_at) return "";
  if (plan->x >= map.width || plan->y >= map.height) {
    return Expected("--focus-at",
                    "a pixel of the picture, up to " + std::to_string(map.width - 1) + "," +
                        std::to_string(map.height - 1),
                    std::to_string(plan->x) + "," + std::to_string(plan->y));
  }
  plan->focus = map.at(plan->x, plan->y);
  return "";
}

std::string CheckRegion(const FloatMap& map, const Options& options, const sf_region& region) {
  if (region.x + region.width <= map.width && region.y + region.height <= map.height) return "";
  return Expected(
      "--region",
      "pixels of the picture, " + std::to_string(map.width) + "x" + std::to_string(map.height),
      options.region);
}

// The largest blur radius, rounded up to whole pixels.
std::string ChooseBlur(const Plan& plan, const sf_disparity_stats& stats, double* max_blur) {
  const double range =
      std::max(std::fabs(stats.min - plan.focus), std::fabs(stats.max - plan.focus));
  const double needed = plan.aperture * range;
  *max_blur = std::max(1.0, std::ceil(needed));
  if (needed <= SF_MAX_BLUR && std::fabs(plan.focus) <= SF_MAX_FOCUS) return "";
  return Expected(plan.focus_at ? "--focus-at" : "--focus",
                  "blur radii up to " + Short(SF_MAX_BLUR) + " pixels",
                  Short(needed) + " (aperture " + Short(plan.aperture) + ", focus " +
                      Short(plan.focus) + ", disparities " + Short(stats.min) + " to " +
                      Short(stats.max) + ")");
}

// Blocks are collected where `blocks` is not null.
EngineTask MakeTask(const Options& options, const Plan& plan, const LightField& light_field,
                    const sf_disparity_stats& stats, double max_blur,
                    std::vector<sf_block>* blocks) {
  EngineTask task;
  task.light_field = &light_field;
  sf_config_init(&task.config);
  task.config.width = light_field.width();
  task.config.height = light_field.height();
  task.config.views = static_cast<int32_t>(light_field.views.size());
  task.config.disparity_min = stats.min;
  task.config.disparity_max = stats.max;
  task.config.max_blur = max_blur;
  task.config.largest_block = plan.largest_block;
  task.config.max_layer = plan.max_layer;
  task.config.deblocking = plan.deblocking;
  task.config.timing = plan.timing;
  sf_params_init(&task.params);
  task.params.mode = plan.mode;
  task.params.rule = plan.rule;
  task.params.focus = plan.focus;
  task.params.aperture = plan.aperture;
  task.params.region = plan.region;
  if (!options.report.empty()) task.params.clock = ThreadNanoseconds;
  if (blocks != nullptr) {
    task.params.on_block = CollectBlock;
    task.params.on_block_data = blocks;
  }
  task.threads = plan.threads;
  task.stream = options.stream;
  return task;
}

std::string Run(const Options& options) {
  const double start = Seconds();
  Plan plan;
  LightField light_field;
  sf_disparity_stats stats = {};
  double max_blur = 0;
  std::string error = MakePlan(options, &plan);
  if (error.empty()) error = Load(options, plan, &light_field);
  if (error.empty()) error = PrepareDisparity(options, &light_field.disparity, &stats);
  if (error.empty()) error = ChooseFocus(light_field.disparity, &plan);
  if (error.empty()) error = CheckRegion(light_field.disparity, options, plan.region);
  if (error.empty()) error = ChooseBlur(plan, stats, &max_blur);
  if (!error.empty()) return error;
  std::vector<sf_block> blocks;
  const EngineTask task = MakeTask(options, plan, light_field, stats, max_blur,
                                   options.map.empty() ? nullptr : &blocks);
  EngineResult result;
  error = RunEngine(options.folder, task, &result);
  if (error.empty()) error = WriteImage(options.out, result.picture);
  if (error.empty() && !options.map.empty()) {
    error = WriteImage(options.map,
                       DrawPartition(result.picture, plan.region.x, plan.region.y, blocks));
  }
  if (error.empty() && !options.report.empty()) {
    const std::string text = ReportText(task, result, Seconds() - start);
    error = WriteFile(options.report, Bytes(text.begin(), text.end()));
  }
  return error;
}

}  // namespace

void AddRefocusCommand(CLI::App* app, Action* action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app->add_subcommand("refocus", "The picture a lens focused at a disparity would have taken");
  command->add_option("DIR", options->folder, "Light-field folder")->required();
  command->add_option("-o,--output", options->out, "Picture to write: .png, .ppm or .jpg")
      ->required();
  command->add_option("--focus", options->focus, "Disparity in focus");
  command->add_option("--focus-at", options->focus_at, "X,Y: the disparity of that pixel");
  command->add_option("--region", options->region,
                      "X,Y,W,H: only that part of the picture, at its share of the time");
  command->add_option("--aperture", options->aperture, "Radius, above 0 up to 1")
      ->capture_default_str();
  command->add_option("--mode", options->mode, "block, frame, benchmark or blur")
      ->capture_default_str();
  command->add_option("--views", options->views, "17, 9, 5 or 1; default: all of the folder");
  command->add_option("--threads", options->threads, "1 to 64")->capture_default_str();
  command->add_flag("--stream", options->stream, "Row by row instead of whole pictures");
  command->add_flag("--fill-invalid", options->fill_invalid,
                    "Replace non-finite disparities by their nearest valid neighbour");
  command->add_option("--largest-block", options->largest_block, "32, 64, 128 or 256")
      ->capture_default_str();
  command->add_option("--rule", options->rule,
                      "paper or cells: how many views a blur needs (default: cells in block mode, "
                      "paper in frame mode)");
  command->add_option("--max-layer", options->max_layer, "0, 1 or 2: may subsample by 2^L")
      ->capture_default_str();
  command
      ->add_option("--deblocking", options->deblocking,
                   "0 to 255 grey levels: the largest step smoothed between layers; 0: off")
      ->capture_default_str();
  command->add_option("--timing", options->timing,
                      "JSON file that starfocus calibrate wrote; default: built in");
  command->add_option("--map", options->map,
                      "Picture to write: the blocks, red for L = 0, green for 1, blue for 2");
  command->add_option("--report", options->report, "JSON file for figures of the run");
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
