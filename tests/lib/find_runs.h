// SPDX-License-Identifier: Apache-2.0
// Finds the runs of lines with the engine's functions, in memory of exactly the required size.
#ifndef STARFOCUS_TESTS_LIB_FIND_RUNS_H_
#define STARFOCUS_TESTS_LIB_FIND_RUNS_H_

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "lib/line_scan/line_scan.h"
#include "simd/kernels.h"

namespace test {

using Depths = std::vector<int16_t>;

// Returns the runs of adjacent lines of equal length. The pixels of a line are stored `step`
// elements apart; `step` is at least the number of lines.
inline std::vector<std::vector<starfocus::Run>> FindRuns(
    const starfocus::simd::LineScanKernels& kernels, const std::vector<Depths>& lines,
    const starfocus::ViewGrid& grid, int range, starfocus::Direction direction, size_t step) {
  const size_t length = lines[0].size();
  std::vector<int16_t> disparity(length * step + starfocus::simd::kPadding / sizeof(int16_t));
  for (size_t k = 0; k < lines.size(); ++k) {
    for (size_t q = 0; q < length; ++q) disparity[q * step + k] = lines[k][q];
  }
  std::vector<uint16_t> starts(starfocus::RunMarkWords(length, lines.size()), 0xCDCD);
  std::vector<uint16_t> edges = starts;
  std::vector<int16_t> middles(starfocus::RunMiddles(length, lines.size()), 0x5A5A);
  starfocus::simd::RunMarks marks = {starts.data(), edges.data(), middles.data(), 0};
  MarkRuns(kernels, int16_t(range), disparity.data(), ptrdiff_t(step), int32_t(length),
           int32_t(lines.size()), direction, &marks);
  std::vector<std::vector<starfocus::Run>> found;
  for (size_t k = 0; k < lines.size(); ++k) {
    std::vector<starfocus::Run> runs(length);
    const int32_t count = ReadRuns(marks, int32_t(k), int32_t(length), grid,
                                   grid.n() == 0 ? 0 : grid.Move(1), runs.data());
    REQUIRE(count >= 1);
    REQUIRE(count <= int32_t(length));
    runs.resize(size_t(count));
    found.push_back(runs);
  }
  return found;
}

inline std::vector<starfocus::Run> FindRuns(const Depths& line, const starfocus::ViewGrid& grid,
                                            int range, starfocus::Direction direction) {
  return FindRuns(starfocus::simd::BestLineScanKernels(), {line}, grid, range, direction, 1)[0];
}

}  // namespace test

#endif  // STARFOCUS_TESTS_LIB_FIND_RUNS_H_
