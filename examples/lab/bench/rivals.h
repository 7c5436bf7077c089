// SPDX-License-Identifier: Apache-2.0
// Installed programs that blur the centre view by a map of blur radii, which the bench compares
// with the engine. Used by bench.cc and measure.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_RIVALS_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_RIVALS_H_

#include <string>
#include <vector>

#include "examples/lab/bench/field.h"
#include "platform/result.h"

namespace starfocus::bench {

// A program that blurs the centre view by a map of blur radii.
struct Tool {
  const char* name;     // Name of the program in the bench's tables.
  const char* program;  // Name of the program, which must be in PATH.
};
// Returns all tools that the bench can measure.
const std::vector<Tool>& Tools();
// Returns true if the program of the tool is in PATH.
bool IsInstalled(const Tool& tool);

struct ToolResult {
  Image picture;
  // Median processor time of one picture in seconds: the time of 1 + m pictures minus the time of
  // one picture, divided by m.
  double seconds = 0;
  std::vector<double> each;  // processor time of each repetition, seconds
};

// Blurs the centre view of `field`, focused at `focus` with aperture 1. Tries several ratios of the
// tool's unit of blur to a blur radius of one pixel, and keeps the picture with the highest PSNR
// against `truth`. Temporary files are written to `folder`.
Error RunTool(const Tool& tool, const Field& field, double focus, const Image& truth,
              const std::string& folder, int repetitions, ToolResult* result);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_RIVALS_H_
