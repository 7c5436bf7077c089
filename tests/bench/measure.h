// SPDX-License-Identifier: Apache-2.0
// Measures several ways to make one picture against each other.
#ifndef STARFOCUS_TESTS_BENCH_MEASURE_H_
#define STARFOCUS_TESTS_BENCH_MEASURE_H_

#include <string>
#include <vector>

#include "platform/result.h"
#include "tests/bench/field.h"
#include "tests/bench/row.h"

namespace starfocus::bench {

struct Settings {
  int repetitions = 5;
  double patience = 3;  // seconds per task beyond which repetitions are dropped
  std::string folder;   // for the files of other programs
  bool rivals = true;
};

struct Entry {
  std::string study;
  Task task;
};

// One picture: the tasks take turns, so that a slow moment of the machine hits all of them.
struct Group {
  const Field* field = nullptr;
  double aperture = 1, focus = 0, quantile = kNone;
  std::vector<Entry> entries;
  bool tools = false;  // also other programs, where there is a truth to compare with
};

Error MeasureGroup(const Group& group, const Settings& settings, std::vector<Row>* rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_MEASURE_H_
