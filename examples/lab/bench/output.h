// SPDX-License-Identifier: Apache-2.0
// Describes the machine, compiler and version, and writes the rows of the bench.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_

#include <string>
#include <vector>

#include "examples/lab/bench/timed_engine.h"

namespace starfocus::bench {

struct Machine {
  std::string cpu, target, compiler, version;
};

// Returns the description of this machine. `revision` is appended to the version, unless it is
// empty.
Machine ThisMachine(const std::string& revision);

// Writes rows as CSV and JSON.

std::string ToCsv(const Machine& machine, const std::vector<Row>& rows);
std::string ToJson(const Machine& machine, const std::vector<Row>& rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_
