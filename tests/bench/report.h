// SPDX-License-Identifier: Apache-2.0
// The report: one HTML page with everything inside.
#ifndef STARFOCUS_TESTS_BENCH_REPORT_H_
#define STARFOCUS_TESTS_BENCH_REPORT_H_

#include <string>
#include <vector>

#include "tests/bench/counts.h"
#include "tests/bench/machine.h"
#include "tests/bench/row.h"

namespace starfocus::bench {

struct Findings {
  Machine machine;
  std::vector<Row> rows;
  std::vector<std::string> missing;  // rivals that are not installed
  std::vector<Counts> counts;
};

// Drawings need gnuplot; without one, the page says so in their place.
std::string MakeReport(const Findings& findings);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_REPORT_H_
