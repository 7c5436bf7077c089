// starfocus refocus: the picture of a lens focused elsewhere.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "engine_run.h"
#include "options.h"
#include "platform/clock.h"
#include "platform/image_io.h"

namespace starfocus {
namespace {

struct Options {
  std::string folder, out, report;
  std::string focus, focus_at, aperture = "1", mode = "frame", views, threads = "1";
  bool stream = false, fill_invalid = false;
};

struct Plan {
  double focus = 0, aperture = 1;
  bool focus_at = false;
  int x = 0, y = 0;
  sf_mode mode = SF_MODE_FRAME;
  int views = 0;  // 0: all there are
  int threads = 1;
};

std::string PlanFocus(const Options& options, Plan* plan) {
  if (options.focus.empty() == options.focus_at.empty()) {
    return Expected("--focus", "either --focus D or --focus-at X,Y",
                    options.focus.empty() ? "neither" : "both");
  }
  plan->focus_at = options.focus.empty();
  if (plan->focus_at) return ParsePair("--focus-at", options.focus_at, ',', &plan->x, &plan->y);
  return ParseNumber("--focus", options.focus, &plan->focus);
}

// Everything that can be refused before a file is read.
std::string MakePlan(const Options& options, Plan* plan) {
  std::string error = CheckImageOutput(options.out);
  if (error.empty() && !options.report.empty()) error = CheckOutputPath(options.report);
  if (error.empty()) error = PlanFocus(options, plan);
  if (error.empty()) error = ParseAperture("--aperture", options.aperture, &plan->aperture);
  if (error.empty()) {
    error = ParseWhole("--threads", options.threads, 1, SF_MAX_WORKERS, &plan->threads);
  }
  if (error.empty() && !options.views.empty()) {
    error = ParseViews("--views", options.views, &plan->views);
  }
  if (!error.empty()) return error;
  if (options.mode != "frame" && options.mode != "benchmark") {
    return Expected("--mode", "frame or benchmark", "'" + options.mode + "'");
  }
  plan->mode = options.mode == "frame" ? SF_MODE_FRAME : SF_MODE_BENCHMARK;
  return "";
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

std::string WriteReport(const Options& options, const Plan& plan, const EngineTask& task,
                        const EngineResult& result, double seconds_total) {
  nlohmann::ordered_json json;
  json["mode"] = options.mode;
  json["width"] = task.config.width;
  json["height"] = task.config.height;
  json["views"] = task.config.views;
  json["focus"] = plan.focus;
  json["aperture"] = plan.aperture;
  json["r_max"] = result.report.r_max;
  json["N"] = result.report.n;
  json["rendered_views"] = result.report.rendered_views;
  json["rendered_samples"] = result.report.rendered_samples;
  json["seconds_refocus"] = result.seconds;
  json["seconds_total"] = seconds_total;
  json["workspace_bytes"] = result.workspace_bytes;
  json["simd_target"] = sf_simd_target();
  json["threads"] = plan.threads;
  const std::string text = json.dump(2) + "\n";
  return WriteFile(options.report, Bytes(text.begin(), text.end()));
}

EngineTask MakeTask(const Options& options, const Plan& plan, const LightField& light_field,
                    const sf_disparity_stats& stats, double max_blur) {
  EngineTask task;
  task.light_field = &light_field;
  sf_config_init(&task.config);
  task.config.width = light_field.width();
  task.config.height = light_field.height();
  task.config.views = static_cast<int32_t>(light_field.views.size());
  task.config.disparity_min = stats.min;
  task.config.disparity_max = stats.max;
  task.config.max_blur = max_blur;
  sf_params_init(&task.params);
  task.params.mode = plan.mode;
  task.params.focus = plan.focus;
  task.params.aperture = plan.aperture;
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
  if (error.empty()) error = ChooseBlur(plan, stats, &max_blur);
  if (!error.empty()) return error;
  const EngineTask task = MakeTask(options, plan, light_field, stats, max_blur);
  EngineResult result;
  error = RunEngine(options.folder, task, &result);
  if (error.empty()) error = WriteImage(options.out, result.picture);
  if (error.empty() && !options.report.empty()) {
    error = WriteReport(options, plan, task, result, Seconds() - start);
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
  command->add_option("--aperture", options->aperture, "Radius, above 0 up to 1")
      ->capture_default_str();
  command->add_option("--mode", options->mode, "frame or benchmark")->capture_default_str();
  command->add_option("--views", options->views, "17, 9, 5 or 1; default: all of the folder");
  command->add_option("--threads", options->threads, "1 to 64")->capture_default_str();
  command->add_flag("--stream", options->stream, "Row by row instead of whole pictures");
  command->add_flag("--fill-invalid", options->fill_invalid,
                    "Replace non-finite disparities by their nearest valid neighbour");
  command->add_option("--report", options->report, "JSON file for figures of the run");
  command->callback([options, action] { *action = [options] { return Run(*options); }; });
}

}  // namespace starfocus
