// SPDX-License-Identifier: Apache-2.0
// Which pictures are measured, and how.
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
  std::vector<int> views;       // star sets below the whole one, in block mode
  std::vector<int> max_layers;  // sweeps at every picture, in block mode
  std::vector<int> superblocks;
  std::vector<double> n_scales;      // of N, in block and frame mode
  bool rules = false;                // both rules for N, in block and frame mode
  std::vector<std::string> targets;  // at the middle quantile; "all": every one
  std::vector<int> workers;          // beside one, at the middle quantile
  double largest_radius = 0;         // of the sweep of blur radii; 0: none
  double largest_megapixels = 0;     // of the sweep of sizes; 0: none
};

// Every mode, option, aperture and focus of a light field, and its truths with the rivals.
Error MeasureField(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

// Time against the blur radius and against the number of pixels.
Error MeasureRadii(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);
Error MeasureSizes(const Field& field, const Choice& choice, const Settings& settings,
                   std::vector<Row>* rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_STUDIES_H_
