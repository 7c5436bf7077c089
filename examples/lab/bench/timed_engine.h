// SPDX-License-Identifier: Apache-2.0
// An engine whose calls are timed: stopwatches of processor time and elapsed time, the rows of the
// results, and the timed engine.
#ifndef STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_
#define STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_

#include <time.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <new>
#include <string>

#include "examples/lab/bench/field.h"
#include "platform/clock.h"
#include "platform/result.h"
#include "platform/runner.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/config.h"

namespace starfocus::bench {

// Returns the processor time of this process in seconds. Other processes affect the processor time
// only through shared caches and memory.
inline double CpuSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Processor time and elapsed time of a run, in seconds.
struct Elapsed {
  double cpu = 0, wall = 0;
};

class Stopwatch {
 public:
  Stopwatch() : cpu_(CpuSeconds()), wall_(Seconds()) {}
  Elapsed Get() const { return {CpuSeconds() - cpu_, Seconds() - wall_}; }

 private:
  double cpu_, wall_;
};

// Defines a row of the bench's output, which holds a measured task and its results.

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

// Creates an engine and its memory for refocusing one light field repeatedly. Used by the bench
// programs.

struct FreeAligned {
  void operator()(void* memory) const {
    ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
  }
};

struct TimedEngine {
  std::unique_ptr<void, FreeAligned> workspace;
  size_t workspace_bytes = 0;
  starfocus_engine* engine = nullptr;
  std::unique_ptr<ThreadRunner> pool;  // thread pool for several workers; null for one worker
  starfocus::Params params;
  test::Report report;
  Image picture;
};

// Returns the starfocus_mode with this name, or -1 if the name is unknown.
int ModeOf(const std::string& name);

// Creates an engine for a task, focus and aperture. Returns a one-line error on failure.
Error Prepare(const Field& field, const Task& task, double focus, double aperture,
              TimedEngine* timed);

// Refocuses once. `elapsed` receives the time that starfocus_refocus takes.
Error RunOnce(const Field& field, const Task& task, TimedEngine* timed, Elapsed* elapsed);

}  // namespace starfocus::bench

#endif  // STARFOCUS_EXAMPLES_LAB_BENCH_TIMED_ENGINE_H_
