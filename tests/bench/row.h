// SPDX-License-Identifier: Apache-2.0
// One measurement: what was run and what came out.
#ifndef STARFOCUS_TESTS_BENCH_ROW_H_
#define STARFOCUS_TESTS_BENCH_ROW_H_

#include <cmath>
#include <cstddef>
#include <string>

#include "starfocus/starfocus.h"

namespace starfocus::bench {

// How a picture is made.
struct Task {
  std::string mode = "block";  // block, frame, benchmark, blur or a rival's name
  int views = 0;
  int max_layer = STARFOCUS_LAYERS - 1;
  int superblock = 0;                      // 0: the library chooses
  int renderer = STARFOCUS_RENDERER_AUTO;  // starfocus_renderer
  double n_scale = 1;                      // of the rule's N
  std::string target;                      // SIMD target; empty: the best one
  int workers = 1;
  bool timed = true;  // blocks, with a clock, which costs instructions
};

inline constexpr double kNone = NAN;  // not measured

struct Quality {
  double psnr = kNone;   // dB
  double ssim = kNone;   // 0 .. 1
  double worst = kNone;  // PSNR of the worst 16x16 block, dB
  double band = kNone;   // PSNR within r_max of depth edges, dB
};

struct Row {
  std::string study;  // what it was measured for: main, options, targets, workers, ...
  std::string field;
  int width = 0, height = 0;
  Task task;
  double aperture = 1, focus = 0;
  double quantile = kNone;  // of the disparity map, where the focus was chosen by one
  double r_max = kNone;
  int n = 0;
  int superblock = 0;  // that the engine used
  double rendered_views = 0, rendered_samples = 0;
  Quality benchmark, truth;  // against the benchmark mode and ray tracing
  double wall_ms = kNone;    // median by the wall clock
  double least_wall_ms = kNone;
  double ms = 0, spread = 0;  // of processor time: median and relative median deviation
  int runs = 0;
  double ratio_frame = kNone, ratio_blur = kNone;  // time of those in the same run / this time
  size_t workspace = 0;
  double layer_time[STARFOCUS_LAYERS] = {0, 0, 0};  // shares of block mode
  double layer_pixels[STARFOCUS_LAYERS] = {0, 0, 0};

  double pixels() const { return double(width) * height; }
  double ns_per_pixel() const { return ms * 1e6 / pixels(); }
  double msamples_per_s() const { return rendered_samples / (ms * 1e3); }
};

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_ROW_H_
