// SPDX-License-Identifier: Apache-2.0
// Chooses the pictures and tasks that are measured. Called by bench.cc.
#ifndef STARFOCUS_TESTS_BENCH_STUDIES_H_
#define STARFOCUS_TESTS_BENCH_STUDIES_H_

#include <string>
#include <vector>

#include "platform/result.h"
#include "tests/bench/field.h"
#include "tests/bench/measure.h"

namespace starfocus::bench {

struct Choice {
  std::vector<std::string> modes = {"block", "frame", "benchmark", "blur"};
  std::vector<double> apertures = {1};
  std::vector<double> quantiles = {0.1, 0.3, 0.5, 0.7, 0.9};
  std::vector<int> views;            // smaller star sets, in block mode
  std::vector<int> max_layers;       // starfocus_tuning.max_layer, in block mode
  std::vector<int> superblocks;      // starfocus_config.superblock, in block mode
  std::vector<double> n_scales;      // starfocus_tuning.n_scale, in block and frame mode
  bool rules = false;                // both renderers, in block and frame mode
  std::vector<std::string> targets;  // SIMD targets, at the middle quantile; "all": all targets
  std::vector<int> workers;          // numbers of workers besides 1, at the middle quantile
  double largest_radius = 0;         // end of the sweep of blur radii, pixels; 0: no sweep
  double largest_megapixels = 0;     // end of the sweep of sizes; 0: no sweep
};

// Measures all chosen modes, options, apertures and foci of a light field. At the foci of the light
// field's truths, rivals are measured as well. Appends the measurements to `rows`.
Error MeasureField(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

// MeasureRadii and MeasureSizes measure the time as a function of the blur radius and of the number
// of pixels.
Error MeasureRadii(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);
Error MeasureSizes(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_STUDIES_H_
