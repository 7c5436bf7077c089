// SPDX-License-Identifier: Apache-2.0
// usage: starfocus-bench-phone FOLDER [VIEWS [RUNS]]
//
// Times what phones compute from the light field in FOLDER: a full picture of 12 megapixels and its
// preview at a quarter of the size with one worker, and a video frame in NV12 with two workers.
// Smaller pictures are tiled, larger ones are cut. The blur is up to 16 pixels. Prints for three
// foci the least time of RUNS runs that alternate between the foci, in milliseconds, and the least
// processor time.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <vector>

#include "examples/lab/bench/timed_engine.h"
#include "platform/runner.h"
#include "starfocus/starfocus.hpp"

namespace starfocus::bench {
namespace {

constexpr double kBlur = 16;                      // Largest blur radius, pixels.
constexpr double kQuantiles[] = {0.1, 0.5, 0.9};  // Quantiles of the map that are in focus.
constexpr int kFoci = int(std::size(kQuantiles));
constexpr int kWidth = 4000, kHeight = 3000;            // Size of the photo, pixels.
constexpr int kFrameWidth = 1920, kFrameHeight = 1080;  // Size of the frame, pixels.
constexpr int kShift = 2;                               // The preview has a quarter of the width.

// Returns an NV12 image whose rows are in `samples`.
starfocus_image Nv12(std::vector<uint8_t>* samples) {
  samples->resize(size_t(kFrameWidth) * kFrameHeight * 3 / 2);
  starfocus_image image = {};
  image.format = STARFOCUS_FORMAT_NV12;
  image.planes[0] = samples->data();
  image.planes[1] = samples->data() + size_t(kFrameWidth) * kFrameHeight;
  image.strides[0] = image.strides[1] = kFrameWidth;
  return image;
}

class Timer {
 public:
  Timer(const Field& field, int views, int workers) : field_(field), runner_(workers) {
    config_.width = field.data.width();
    config_.height = field.data.height();
    config_.views = views;
    config_.disparity_min = field.low;
    config_.disparity_max = field.high;
    config_.max_blur = kBlur;
    config_.max_workers = workers;
    params_.aperture = std::min(1.0, kBlur / double(field.high - field.low));
    for (int k = 0; k < kFoci; ++k) foci_[k] = field.FocusAt(kQuantiles[k]);
  }

  Config* config() { return &config_; }
  Params* params() { return &params_; }

  starfocus_status Init() {
    starfocus_callbacks callbacks = {};
    callbacks.runner = ThreadRunner::Run;
    callbacks.runner_data = &runner_;
    const starfocus_status status = engine_.Init(config_);
    return status == STARFOCUS_OK ? engine_.SetCallbacks(callbacks) : status;
  }

  starfocus_status Prepare() { return engine_.Prepare(Rows(field_.data, config_.views)); }

  // Times refocus(params, engine) for all foci, and prints a line.
  template <class Refocus>
  starfocus_status Time(const char* name, int runs, const Refocus& refocus) {
    Elapsed least[kFoci];
    for (int k = 0; k < kFoci * runs; ++k) {
      params_.focus = foci_[k % kFoci];
      const Stopwatch stopwatch;
      const starfocus_status status = refocus(params_, &engine_);
      if (status != STARFOCUS_OK) return status;
      const Elapsed time = stopwatch.Get();
      Elapsed* const best = &least[k % kFoci];
      *best = k < kFoci ? time
                        : Elapsed{std::min(best->cpu, time.cpu), std::min(best->wall, time.wall)};
    }
    std::printf("%-36s", name);
    for (const Elapsed& time : least) std::printf(" %7.1f (%.1f)", 1e3 * time.wall, 1e3 * time.cpu);
    std::printf("\n");
    return STARFOCUS_OK;
  }

 private:
  const Field& field_;
  ThreadRunner runner_;
  Config config_;
  Params params_;
  double foci_[kFoci];
  Engine engine_;
};

starfocus_status TimePhoto(const Field& field, int views, int runs) {
  const Field photo = Tile(field, kWidth, kHeight, views);
  Timer timer(photo, views, 1);
  timer.config()->previews = kShift;
  starfocus_status status = timer.Init();
  if (status == STARFOCUS_OK) status = timer.Prepare();
  if (status != STARFOCUS_OK) return status;
  Image out(kWidth, kHeight);
  const starfocus_image to = starfocus_image_rgb(out.pixels.data(), out.stride());
  timer.params()->preview_shift = kShift;
  status = timer.Time(
      "12 MP, preview 1/4, 1 worker", 5 * runs,
      [&](const Params& params, Engine* engine) { return engine->RefocusPrepared(params, to); });
  timer.params()->preview_shift = 0;
  if (status != STARFOCUS_OK) return status;
  return timer.Time("12 MP, full picture, 1 worker", runs,
                    [&](const Params& params, Engine* engine) {
                      return engine->Refocus(params, Rows(photo.data, views), to);
                    });
}

starfocus_status TimeFrame(const Field& field, int workers, int runs) {
  const Field frame = Tile(field, kFrameWidth, kFrameHeight, 1);
  Timer timer(frame, 1, workers);
  timer.config()->features |= STARFOCUS_FEATURE_IMAGES;
  starfocus_status status = timer.Init();
  if (status != STARFOCUS_OK) return status;
  std::vector<uint8_t> from, to;
  const starfocus_image in = Nv12(&from), out = Nv12(&to);
  starfocus_light_field rows = Rows(frame.data, 1);
  // A closed aperture converts the frame to NV12.
  Engine converter;
  status = converter.Init(*timer.config());
  Params sharp;
  sharp.aperture = 0;
  if (status == STARFOCUS_OK) status = converter.Refocus(sharp, rows, in);
  if (status != STARFOCUS_OK) return status;
  rows.views[0] = in;
  char name[64];
  std::snprintf(name, sizeof(name), "NV12 1920 x 1080, 1 view, %d worker%s", workers,
                workers > 1 ? "s" : "");
  return timer.Time(name, runs, [&](const Params& params, Engine* engine) {
    return engine->Refocus(params, rows, out);
  });
}

int Run(const char* folder, int views, int runs) {
  Field field;
  if (const Error error = LoadField(folder, &field)) {
    std::fprintf(stderr, "%s\n", error.line().c_str());
    return 1;
  }
  views = std::min(views, field.views());
  std::printf("%s, %d views, %s: ms at three foci (processor time)\n", field.name.c_str(), views,
              starfocus_simd_target());
  starfocus_status status = TimePhoto(field, views, runs);
  for (int workers = 1; workers <= 2 && status == STARFOCUS_OK; ++workers) {
    status = TimeFrame(field, workers, 2 * runs);
  }
  if (status == STARFOCUS_OK) return 0;
  std::fprintf(stderr, "%s: %s\n", folder, starfocus_status_string(status));
  return 1;
}

}  // namespace
}  // namespace starfocus::bench

int main(int argc, char** argv) {
  const int views = argc > 2 ? std::atoi(argv[2]) : 1, runs = argc > 3 ? std::atoi(argv[3]) : 10;
  if (argc < 2 || argc > 4 || views < 1 || runs < 1) {
    std::fprintf(stderr, "usage: starfocus-bench-phone FOLDER [VIEWS [RUNS]]\n");
    return 1;
  }
  return starfocus::bench::Run(argv[1], views, runs);
}
