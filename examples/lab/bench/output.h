// SPDX-License-Identifier: Apache-2.0
// Writes rows as CSV and JSON.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_

#include <string>
#include <vector>

#include "examples/lab/bench/machine.h"
#include "examples/lab/bench/row.h"

namespace starfocus::bench {

std::string ToCsv(const Machine& machine, const std::vector<Row>& rows);
std::string ToJson(const Machine& machine, const std::vector<Row>& rows);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_OUTPUT_H_
