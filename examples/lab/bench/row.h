// SPDX-License-Identifier: Apache-2.0
// Defines a row of the bench's output, which holds a measured task and its results.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_ROW_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_ROW_H_

#include <cmath>
#include <cstddef>
#include <string>

#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"

namespace starfocus::bench {

// Mode and options with which a picture is computed.
struct Task {
  std::string mode = "block";  // block, frame, benchmark or blur, or the name of a rival
  int views = 0;
  int max_layer = STARFOCUS_LAYERS - 1;
  int superblock = 0;  // Side of superblocks, pixels; 0: default of the library.
  int renderer = STARFOCUS_RENDERER_AUTO;  // Value of starfocus_renderer.
  double n_scale = 1;                      // Value of starfocus_tuning.n_scale.
  std::string target;                      // SIMD target; empty: the best target of the machine.
  int workers = 1;
  bool timed = true;  // true if the time of each block is measured, which costs instructions
};

inline constexpr double kNone = NAN;  // not measured

struct Quality {
  double psnr = kNone;   // PSNR of the whole picture, dB.
  double ssim = kNone;   // Mean structural similarity, at most 1.
  double worst = kNone;  // PSNR of the worst 16x16 block, dB.
  double band = kNone;   // PSNR within r_max of depth edges, dB.
};

struct Row {
  std::string study;  // purpose of the measurement: main, options, targets, workers, ...
  std::string field;
  int width = 0, height = 0;
  Task task;
  double aperture = 1, focus = 0;
  // Quantile of the disparity map that is in focus; kNone if the focus was given.
  double quantile = kNone;
  double r_max = kNone;  // Largest blur radius, pixels.
  int n = 0;             // Largest N of all blocks.
  int superblock = 0;    // Side of the superblocks that the engine used, pixels.
  double rendered_views = 0, rendered_samples = 0;
  // Quality of the picture compared with benchmark mode and with ray tracing.
  Quality benchmark, truth;
  double wall_ms = kNone;        // Median elapsed time, ms.
  double least_wall_ms = kNone;  // Smallest elapsed time, ms.
  double ms = 0, spread = 0;  // Median processor time in ms, and Spread (metrics.h) of the times.
  int runs = 0;               // Number of measured repetitions.
  // Processor time of frame mode and of blur mode for the same picture, divided by the processor
  // time of this task.
  double ratio_frame = kNone, ratio_blur = kNone;
  size_t workspace = 0;                             // Size of the workspace, bytes.
  double layer_time[STARFOCUS_LAYERS] = {0, 0, 0};  // Share of the time of all blocks, by layer.
  // Share of the pixels of all blocks, by layer.
  double layer_pixels[STARFOCUS_LAYERS] = {0, 0, 0};

  double pixels() const { return double(width) * height; }
  double ns_per_pixel() const { return ms * 1e6 / pixels(); }
  double msamples_per_s() const { return rendered_samples / (ms * 1e3); }
};

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_ROW_H_
