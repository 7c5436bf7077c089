// SPDX-License-Identifier: Apache-2.0
// Rivals are other methods of refocusing that the bench compares with the engine. rivals.cc
// implements shift-and-add of the captured views. The other rivals are installed programs that blur
// the centre view by a map of blur radii. Used by bench.cc and measure.cc.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_RIVALS_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_RIVALS_H_

#include <string>
#include <vector>

#include "examples/lab/bench/field.h"
#include "platform/result.h"

namespace starfocus::bench {

// Computes the weighted mean of `views` captured views, each shifted with bilinear interpolation so
// that disparity `focus` is in focus. The result is the picture through a lens of aperture 1 that
// consists of `views` pinholes.
class ShiftAndAdd {
 public:
  ShiftAndAdd(const LightField& data, int views, double focus);
  void Run(Image* out);

 private:
  void AddView(const Image& view, int index, int y);

  const LightField& data_;
  const int views_;
  const double focus_;
  int pad_ = 0;                // Samples of padding on each side of a row.
  std::vector<uint8_t> row_;   // Row that is interpolated between two rows of a view, with padding.
  std::vector<uint16_t> sum_;  // Weighted sums of a row of the picture.
  std::vector<uint16_t> weights_;
};

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
