// SPDX-License-Identifier: Apache-2.0
// Measures several ways to compute the same picture. Used by studies.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_

#include <string>
#include <vector>

#include "examples/lab/bench/field.h"
#include "examples/lab/bench/row.h"
#include "platform/result.h"

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

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_MEASURE_H_
