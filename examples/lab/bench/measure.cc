// SPDX-License-Identifier: Apache-2.0

#include "examples/lab/bench/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "examples/lab/bench/metrics.h"
#include "examples/lab/bench/rivals.h"
#include "examples/lab/bench/shift_and_add.h"
#include "examples/lab/bench/timed_engine.h"
#include "simd/kernels.h"
#include "starfocus/experimental.h"

namespace starfocus::bench {
namespace {

struct Run {
  const Entry* entry;
  TimedEngine timed;
  std::unique_ptr<ShiftAndAdd> shift_and_add;
  std::vector<double> seconds, walls;
  size_t wanted = 1;
};

Error Once(const Field& field, Run* run, Elapsed* elapsed) {
  if (run->shift_and_add == nullptr) {
    return RunOnce(field, run->entry->task, &run->timed, elapsed);
  }
  const Stopwatch stopwatch;
  run->shift_and_add->Run(&run->timed.picture);
  *elapsed = stopwatch.Get();
  return {};
}

Error Start(const Group& group, const Entry& entry, Run* run) {
  run->entry = &entry;
  if (entry.task.mode != "shift-and-add") {
    return Prepare(*group.field, entry.task, group.focus, group.aperture, &run->timed);
  }
  const LightField& data = group.field->data;
  run->shift_and_add =
      std::make_unique<ShiftAndAdd>(*group.field, entry.task.views, group.focus, entry.task.target);
  run->timed.picture = Image(data.width(), data.height());
  return {};
}

void Note(const Elapsed& elapsed, Run* run) {
  run->seconds.push_back(elapsed.cpu);
  run->walls.push_back(elapsed.wall);
}

// Runs the task once to warm up, and derives the number of repetitions from the elapsed time. If
// the warm-up run takes longer than `patience`, this run counts as a measurement.
Error WarmUp(const Field& field, const Settings& settings, Run* run) {
  Elapsed elapsed;
  const Error error = Once(field, run, &elapsed);
  const double fit = settings.patience / std::max(elapsed.wall, 1e-9);
  run->wanted = size_t(std::clamp(fit, 1.0, double(settings.repetitions)));
  if (elapsed.wall > settings.patience) Note(elapsed, run);
  return error;
}

// Runs all tasks in turn until each task has the intended number of measurements.
Error TakeTurns(const Field& field, const Settings& settings, std::vector<Run>* runs) {
  for (int turn = 0; turn < settings.repetitions; ++turn) {
    for (Run& run : *runs) {
      if (run.seconds.size() >= run.wanted) continue;
      Elapsed elapsed;
      if (Error error = Once(field, &run, &elapsed)) return error;
      Note(elapsed, &run);
    }
  }
  return {};
}

const Run* FindMode(const std::vector<Run>& runs, const char* mode, int views) {
  const Run* found = nullptr;
  for (const Run& run : runs) {
    const Task& task = run.entry->task;
    if (task.mode != mode || !task.target.empty() || task.renderer != STARFOCUS_RENDERER_AUTO ||
        task.n_scale != 1 || task.workers != 1) {
      continue;
    }
    if (found == nullptr || task.views == views) found = &run;
  }
  return found;
}

// Measures the quality against the benchmark picture (unless null), and against the ray-traced
// picture if the folder has this picture.
void Judge(const Group& group, const Image& picture, const Image* benchmark, Row* row) {
  const Image* truth = group.field->FindTruth(group.focus, group.aperture);
  const auto judge = [&](const Image& reference, Quality* quality) {
    quality->psnr = Psnr(picture, reference);
    quality->ssim = Ssim(picture, reference);
    quality->worst = WorstBlockPsnr(picture, reference);
    const int radius = int(std::ceil(row->r_max));
    quality->band = MaskedPsnr(picture, reference, EdgeBand(group.field->data.disparity, radius));
  };
  if (benchmark != nullptr) judge(*benchmark, &row->benchmark);
  if (truth != nullptr) judge(*truth, &row->truth);
}

Row CommonRow(const Group& group, const Entry& entry) {
  Row row;
  row.study = entry.study;
  row.field = group.field->name;
  row.width = group.field->data.width();
  row.height = group.field->data.height();
  row.task = entry.task;
  row.aperture = group.aperture;
  row.focus = group.focus;
  row.quantile = group.quantile;
  row.r_max = group.field->LargestBlur(group.focus, group.aperture);
  return row;
}

void AddReport(const test::Report& report, Row* row) {
  row->n = report.n;
  row->superblock = report.superblock;
  row->rendered_samples = double(report.rendered_samples);
  double time = 0, pixels = 0;
  for (const starfocus_layer_report& layer : report.layers) {
    row->rendered_views += double(layer.views);
    time += double(layer.measured_ns);
    pixels += double(layer.pixels);
  }
  if (row->task.mode != "block") row->rendered_views = report.rendered_views;
  for (int i = 0; i < STARFOCUS_LAYERS; ++i) {
    if (time > 0) row->layer_time[i] = double(report.layers[i].measured_ns) / time;
    if (pixels > 0) row->layer_pixels[i] = double(report.layers[i].pixels) / pixels;
  }
}

Row MakeRow(const Group& group, const std::vector<Run>& runs, const Run& run) {
  Row row = CommonRow(group, *run.entry);
  if (run.shift_and_add == nullptr) {
    AddReport(run.timed.report, &row);
    row.workspace = run.timed.workspace_bytes;
  } else {
    row.rendered_views = row.task.views;
    row.rendered_samples = 3 * row.pixels() * row.task.views;
  }
  const double median = Median(run.seconds);
  row.ms = 1e3 * median;
  row.wall_ms = 1e3 * Median(run.walls);
  row.least_wall_ms = 1e3 * *std::min_element(run.walls.begin(), run.walls.end());
  row.spread = Spread(run.seconds);
  row.runs = int(run.seconds.size());
  const Run* frame = FindMode(runs, "frame", row.task.views);
  const Run* blur = FindMode(runs, "blur", row.task.views);
  const Run* benchmark = FindMode(runs, "benchmark", group.field->views());
  if (frame != nullptr) row.ratio_frame = Median(frame->seconds) / median;
  if (blur != nullptr) row.ratio_blur = Median(blur->seconds) / median;
  const Image* reference =
      benchmark == nullptr || benchmark == &run ? nullptr : &benchmark->timed.picture;
  Judge(group, run.timed.picture, reference, &row);
  return row;
}

Error MeasureTools(const Group& group, const Settings& settings, const Image* benchmark,
                   std::vector<Row>* rows) {
  const Image* truth = group.field->FindTruth(group.focus, group.aperture);
  if (truth == nullptr) return {};
  for (const Tool& tool : Tools()) {
    if (!IsInstalled(tool)) continue;
    ToolResult result;
    const Error error = RunTool(tool, *group.field, group.focus, *truth, settings.folder,
                                settings.repetitions, &result);
    if (error) {
      std::fprintf(stderr, "%s\nleft out: %s\n", error.line().c_str(), tool.name);
      continue;
    }
    Entry entry;
    entry.study = "rivals";
    entry.task.mode = tool.name;
    entry.task.views = 1;
    Row row = CommonRow(group, entry);
    row.ms = 1e3 * result.seconds;
    row.spread = Spread(result.each);
    row.runs = int(result.each.size());
    Judge(group, result.picture, benchmark, &row);
    rows->push_back(row);
  }
  return {};
}

}  // namespace

Error MeasureGroup(const Group& group, const Settings& settings, std::vector<Row>* rows) {
  std::vector<Run> runs(group.entries.size());
  for (size_t i = 0; i < runs.size(); ++i) {
    if (Error error = Start(group, group.entries[i], &runs[i])) return error;
    if (Error error = WarmUp(*group.field, settings, &runs[i])) return error;
  }
  if (Error error = TakeTurns(*group.field, settings, &runs)) return error;
  for (const Run& run : runs) rows->push_back(MakeRow(group, runs, run));
  if (!group.tools || !settings.rivals) return {};
  const Run* benchmark = FindMode(runs, "benchmark", group.field->views());
  return MeasureTools(group, settings, benchmark == nullptr ? nullptr : &benchmark->timed.picture,
                      rows);
}

namespace {

constexpr int kSweepViews = 5;  // Sweeps use few views, so that large light fields fit into memory.
constexpr double kSweepRadius = 8;  // Largest blur radius of the sweep of sizes, pixels.

Entry MakeEntry(const char* study, const std::string& mode, int views) {
  Entry entry;
  entry.study = study;
  entry.task.mode = mode;
  entry.task.views = views;
  return entry;
}

void AddModes(const Field& field, const Choice& choice, Group* group) {
  for (const std::string& mode : choice.modes) {
    group->entries.push_back(MakeEntry("main", mode, field.views()));
  }
}

void AddOptions(const Field& field, const Choice& choice, Group* group) {
  for (const int views : choice.views) {
    if (views < field.views()) group->entries.push_back(MakeEntry("views", "block", views));
  }
  const Entry base = MakeEntry("options", "block", field.views());
  for (const int layer : choice.max_layers) {
    group->entries.push_back(base);
    group->entries.back().task.max_layer = layer;
  }
  for (const char* mode : {"block", "frame"}) {
    for (const int renderer : {STARFOCUS_RENDERER_LINE_SCAN, STARFOCUS_RENDERER_SLICES}) {
      if (!choice.rules) continue;
      group->entries.push_back(MakeEntry("options", mode, field.views()));
      group->entries.back().task.renderer = renderer;
    }
  }
  for (const int side : choice.superblocks) {
    group->entries.push_back(base);
    group->entries.back().task.superblock = side;
  }
  for (const char* mode : {"block", "frame"}) {
    for (const double scale : choice.n_scales) {
      group->entries.push_back(MakeEntry("options", mode, field.views()));
      group->entries.back().task.n_scale = scale;
    }
  }
}

void AddTargets(const Field& field, const Choice& choice, Group* group) {
  std::vector<std::string> names = choice.targets;
  if (names == std::vector<std::string>{"all"}) {
    names.clear();
    const simd::Kernels* kernels = nullptr;
    for (size_t i = 0; (kernels = simd::KernelsOfTarget(i)) != nullptr; ++i) {
      names.push_back(kernels->name);
    }
    names.push_back(simd::ReferenceKernels().name);
  }
  for (const std::string& name : names) {
    for (const char* mode : {"block", "frame", "benchmark", "blur"}) {
      group->entries.push_back(MakeEntry("targets", mode, field.views()));
      group->entries.back().task.target = name;
    }
  }
}

// Adds a task for each number of workers, and a task with one worker as the reference.
void AddWorkers(const Field& field, const Choice& choice, Group* group) {
  if (choice.workers.empty()) return;
  std::vector<int> numbers = choice.workers;
  numbers.insert(numbers.begin(), 1);
  for (const char* mode : {"block", "frame", "benchmark", "blur"}) {
    for (const int workers : numbers) {
      group->entries.push_back(MakeEntry("workers", mode, field.views()));
      group->entries.back().task.workers = workers;
    }
  }
}

void AddRivals(const Field& field, Group* group) {
  for (const int views : {5, 9, 17}) {
    if (views > field.views()) continue;
    group->entries.push_back(MakeEntry("rivals", "shift-and-add", views));
  }
  group->tools = true;
}

void Say(const Field& field, const char* what, double value) {
  std::fprintf(stderr, "%s: %s %.4g\n", field.name.c_str(), what, value);
}

bool IsTruth(const Field& field, const Group& group) {
  return field.FindTruth(group.focus, group.aperture) != nullptr;
}

}  // namespace

Error MeasureField(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows) {
  std::vector<Group> groups;
  for (const double aperture : choice.apertures) {
    for (const double quantile : choice.quantiles) {
      Group group = {&field, aperture, field.FocusAt(quantile), quantile, {}};
      // The foci do not depend on the aperture, so options are measured with aperture 1 only.
      AddModes(field, choice, &group);
      if (aperture == 1) AddOptions(field, choice, &group);
      const bool middle = quantile == choice.quantiles[choice.quantiles.size() / 2];
      if (aperture == 1 && middle) AddTargets(field, choice, &group);
      if (aperture == 1 && middle) AddWorkers(field, choice, &group);
      groups.push_back(group);
    }
  }
  for (const Truth& truth : field.truths) {
    Group group = {&field, truth.aperture, truth.focus, kNone, {}};
    AddModes(field, choice, &group);
    if (truth.aperture == 1) AddOptions(field, choice, &group);
    if (truth.aperture == 1 && settings.rivals) AddRivals(field, &group);
    groups.push_back(group);
  }
  for (const Group& group : groups) {
    Say(field, IsTruth(field, group) ? "against truth, focus" : "focus", group.focus);
    if (Error error = MeasureGroup(group, settings, rows)) return error;
  }
  return {};
}

namespace {

Error MeasureSweep(const Field& field, const char* study, double focus, const Settings& settings,
                   std::vector<Row>* rows) {
  Group group = {&field, 1, focus, kNone, {}};
  for (const char* mode : {"block", "frame", "benchmark", "blur"}) {
    group.entries.push_back(MakeEntry(study, mode, field.views()));
  }
  return MeasureGroup(group, settings, rows);
}

// Returns the field with scaled disparities, so that the largest blur radius is `radius` if the
// median disparity is in focus.
Field WithRadius(const Field& field, double radius) {
  const double now = field.LargestBlur(field.FocusAt(0.5), 1);
  return Stretch(field, now > 0 ? radius / now : 0, std::min(kSweepViews, field.views()));
}

}  // namespace

Error MeasureRadii(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows) {
  for (const double radius : {0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
    if (radius > choice.largest_radius) break;
    Say(field, "blur radius", radius);
    const Field stretched = WithRadius(field, radius);
    if (Error error = MeasureSweep(stretched, "radius", stretched.FocusAt(0.5), settings, rows))
      return error;
  }
  return {};
}

Error MeasureSizes(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows) {
  const Field stretched = WithRadius(field, kSweepRadius);
  for (const double megapixels : {0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    if (megapixels > choice.largest_megapixels) break;
    Say(field, "megapixels", megapixels);
    const int height = int(std::lround(std::sqrt(megapixels * 1e6 * 3 / 4)));
    const Field tiled = Tile(stretched, height * 4 / 3, height, kSweepViews);
    if (Error error = MeasureSweep(tiled, "pixels", stretched.FocusAt(0.5), settings, rows))
      return error;
  }
  return {};
}

}  // namespace starfocus::bench
