// SPDX-License-Identifier: Apache-2.0
// Instructions per pixel from the tracked baselines of `./do bench --check` and `./do count`.
#ifndef STARFOCUS_TESTS_BENCH_COUNTS_H_
#define STARFOCUS_TESTS_BENCH_COUNTS_H_

#include <string>
#include <vector>

#include "platform/result.h"

namespace starfocus::bench {

// Of a case of tests/instruction_bench.cc, with the kernels of a SIMD target and the plain ones;
// NaN where a file does not tell.
struct Counts {
  std::string name;
  double x86_simd, x86_plain, arm_simd, arm_plain;
};

// x86: lines "CASE simd|reference INSTRUCTIONS-PER-PIXEL"; arm: "CASE simd|reference PIXELS
// INSTRUCTIONS". Other lines are passed over. An empty path is no file. Errors are lines.
Error ReadCounts(const std::string& x86, const std::string& arm, std::vector<Counts>* counts);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_COUNTS_H_
