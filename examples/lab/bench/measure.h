// SPDX-License-Identifier: Apache-2.0
// Measures several ways to compute the same picture, and the studies of options and sizes.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_

#include <string>
#include <vector>

#include "examples/lab/bench/field.h"
#include "examples/lab/bench/timed_engine.h"
#include "platform/result.h"
#include "starfocus/starfocus.hpp"

namespace starfocus::bench {

struct Settings {
  int repetitions = 5;
  double patience = 3;  // Time limit per task in seconds; repetitions beyond the limit are omitted.
  std::string folder;   // Folder for temporary files of the rivals (rivals.h).
  bool rivals = true;   // True to measure the rivals.
};

struct Entry {
  std::string study;
  Task task;
};

// The tasks that compute one picture. The tasks run in turn, so that a temporary slowdown of the
// machine affects all of them.
struct Group {
  const Field* field = nullptr;
  double aperture = 1, focus = 0, quantile = kNone;
  std::vector<Entry> entries;
  bool tools = false;  // true to run Tools() of rivals.h; requires a ray-traced picture
};

// Measures all tasks of a group, and appends one row per task to `rows`.
Error MeasureGroup(const Group& group, const Settings& settings, std::vector<Row>* rows);

// Chooses the pictures and tasks that are measured. Called by bench.cc.

struct Choice {
  std::vector<std::string> modes = {"block", "frame", "benchmark", "blur"};
  std::vector<double> apertures = {1};
  std::vector<double> quantiles = {0.1, 0.3, 0.5, 0.7, 0.9};
  std::vector<int> views;        // Sizes of smaller star sets, measured in block mode.
  std::vector<int> max_layers;   // Values of starfocus_tuning.max_layer, measured in block mode.
  std::vector<int> superblocks;  // Values of starfocus::Config.superblock, measured in block mode.
  std::vector<double> n_scales;  // Values of starfocus_tuning.n_scale in block and frame mode.
  bool rules = false;            // True to measure both renderers in block and frame mode.
  // SIMD targets, measured at the middle quantile; "all": all targets.
  std::vector<std::string> targets;
  std::vector<int> workers;       // Numbers of workers above 1, measured at the middle quantile.
  double largest_radius = 0;      // Largest radius of the sweep of blur radii, pixels; 0: no sweep.
  double largest_megapixels = 0;  // Largest picture of the sweep of sizes; 0: no sweep.
};

// Measures a light field with all chosen modes, options, apertures and foci. Measures rivals at the
// foci of the ray-traced pictures. Appends the measurements to `rows`.
Error MeasureField(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

// MeasureRadii and MeasureSizes measure the time as a function of the blur radius and of the number
// of pixels.
Error MeasureRadii(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);
Error MeasureSizes(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_
