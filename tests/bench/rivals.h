// SPDX-License-Identifier: Apache-2.0
// What else makes refocused pictures: plain shift-and-add of the captured views, written here, and
// programs that blur one picture by a map, when they are installed.
#ifndef STARFOCUS_TESTS_BENCH_RIVALS_H_
#define STARFOCUS_TESTS_BENCH_RIVALS_H_

#include <string>
#include <vector>

#include "platform/result.h"
#include "tests/bench/field.h"

namespace starfocus::bench {

// The weighted mean of `views` captured views, each shifted by its share of `focus` with bilinear
// interpolation: the picture of a lens that consists of so many pinholes (aperture 1).
class ShiftAndAdd {
 public:
  ShiftAndAdd(const LightField& data, int views, double focus);
  void Run(Image* out);

 private:
  void AddView(const Image& view, int index, int y);

  const LightField& data_;
  const int views_;
  const double focus_;
  int pad_ = 0;                // samples on either side of a row
  std::vector<uint8_t> row_;   // a row between two rows of a view, its ends repeated
  std::vector<uint16_t> sum_;  // of a row of the picture
  std::vector<uint16_t> weights_;
};

// A program that blurs the centre view by a map of blur radii.
struct Tool {
  const char* name;     // as in the tables
  const char* program;  // looked up in PATH
};
const std::vector<Tool>& Tools();
bool IsInstalled(const Tool& tool);

struct ToolResult {
  Image picture;
  double seconds = 0;  // for one more picture: of k + m pictures less that of k, over m
  std::vector<double> each;
};

// Blurs `field` focused at `focus` with aperture 1. The ratio of the tool's unit to the blur radius
// is chosen among several for the best PSNR against `truth`. `folder` is for its files.
Error RunTool(const Tool& tool, const Field& field, double focus, const Image& truth,
              const std::string& folder, int repetitions, ToolResult* result);

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_RIVALS_H_
