// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/studies.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "simd/kernels.h"
#include "starfocus/experimental.h"

namespace starfocus::bench {
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
