// SPDX-License-Identifier: Apache-2.0
// A measurement: the task and its results. One row of the output of the bench.
#ifndef STARFOCUS_TESTS_BENCH_ROW_H_
#define STARFOCUS_TESTS_BENCH_ROW_H_

#include <cmath>
#include <cstddef>
#include <string>

#include "starfocus/starfocus.h"

namespace starfocus::bench {

// A way to compute a picture.
struct Task {
  std::string mode = "block";  // block, frame, benchmark, blur, or the name of a rival
  int views = 0;
  int max_layer = STARFOCUS_LAYERS - 1;
  int superblock = 0;                      // 0: default of the library
  int renderer = STARFOCUS_RENDERER_AUTO;  // starfocus_renderer
  double n_scale = 1;                      // starfocus_tuning.n_scale
  std::string target;                      // SIMD target; empty: the best one
  int workers = 1;
  bool timed = true;  // true if the time of each block is measured, which costs instructions
};

inline constexpr double kNone = NAN;  // not measured

struct Quality {
  double psnr = kNone;   // dB
  double ssim = kNone;   // at most 1
  double worst = kNone;  // PSNR of the worst 16x16 block, dB
  double band = kNone;   // PSNR within r_max of depth edges, dB
};

struct Row {
  std::string study;  // purpose of the measurement: main, options, targets, workers, ...
  std::string field;
  int width = 0, height = 0;
  Task task;
  double aperture = 1, focus = 0;
  double quantile = kNone;  // the focus is this quantile of the disparity map; kNone: given
  double r_max = kNone;     // largest blur radius, pixels
  int n = 0;                // N, the largest of all blocks
  int superblock = 0;       // side of the superblocks that the engine used, pixels
  double rendered_views = 0, rendered_samples = 0;
  Quality benchmark, truth;      // against the benchmark mode, and against ray tracing
  double wall_ms = kNone;        // median elapsed time
  double least_wall_ms = kNone;  // smallest elapsed time
  double ms = 0, spread = 0;     // processor time: median, and Spread of metrics.h
  int runs = 0;                  // number of measured runs
  // Processor time of frame mode and of blur mode for the same picture, divided by the processor
  // time of this task.
  double ratio_frame = kNone, ratio_blur = kNone;
  size_t workspace = 0;                               // bytes
  double layer_time[STARFOCUS_LAYERS] = {0, 0, 0};    // shares of the time of all blocks
  double layer_pixels[STARFOCUS_LAYERS] = {0, 0, 0};  // shares of the pixels of all blocks

  double pixels() const { return double(width) * height; }
  double ns_per_pixel() const { return ms * 1e6 / pixels(); }
  double msamples_per_s() const { return rendered_samples / (ms * 1e3); }
};

}  // namespace starfocus::bench

#endif  // STARFOCUS_TESTS_BENCH_ROW_H_
