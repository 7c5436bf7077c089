// SPDX-License-Identifier: Apache-2.0
#include "examples/lab/bench/timed_engine.h"

#include <algorithm>
#include <cmath>

#include "platform/file.h"
#include "simd/kernels.h"
#include "starfocus/starfocus.hpp"
#include "tests/support/inside.h"
#include "tests/support/test_scene.h"

namespace starfocus::bench {
namespace {

const char* const kModes[] = {"frame", "benchmark", "block", "blur"};

uint64_t Nanoseconds() { return static_cast<uint64_t>(CpuSeconds() * 1e9); }

// Makes the engine use the SIMD target `name` instead of the best target. No-op if `name` is empty.
Error UseTarget(const std::string& name, starfocus_engine* engine) {
  if (name.empty()) return {};
  const simd::Kernels& plain = simd::ReferenceKernels();
  const simd::Kernels* kernels = name == plain.name ? &plain : simd::FindKernels(name.c_str());
  if (kernels == nullptr) return Expected("target", "a SIMD target of this machine", name);
  test::UseKernels(kernels, engine);
  return {};
}

}  // namespace

int ModeOf(const std::string& name) {
  const auto found = std::find(std::begin(kModes), std::end(kModes), name);
  return found == std::end(kModes) ? -1 : int(found - std::begin(kModes));
}

Error Prepare(const Field& field, const Task& task, double focus, double aperture,
              TimedEngine* timed) {
  starfocus::Config config;
  config.width = field.data.width();
  config.height = field.data.height();
  config.views = task.views;
  config.disparity_min = field.low;
  config.disparity_max = field.high;
  config.max_blur = std::max(1.0, std::ceil(field.LargestBlur(focus, aperture)));
  config.transfer = field.transfer;
  config.tuning.line_scan = starfocus_line_scan_renderer();
  config.tuning.max_layer = task.max_layer;
  config.superblock = task.superblock;
  config.tuning.n_scale = task.n_scale;
  config.max_workers = task.workers;
  if (task.workers > 1) timed->pool = std::make_unique<ThreadRunner>(task.workers);
  starfocus_status status = starfocus_workspace_size(&config, &timed->workspace_bytes, nullptr);
  if (status == STARFOCUS_OK) {
    timed->workspace.reset(
        ::operator new (timed->workspace_bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
    status = starfocus_init(&config, timed->workspace.get(), timed->workspace_bytes, &timed->engine,
                            nullptr);
  }
  if (status != STARFOCUS_OK) {
    return Expected(field.name, "a light field that the engine accepts",
                    starfocus_status_string(status));
  }
  timed->params.study.mode = ModeOf(task.mode);
  timed->params.study.renderer = task.renderer;
  timed->params.focus = focus;
  timed->params.aperture = aperture;
  timed->picture = Image(config.width, config.height);
  starfocus_callbacks callbacks = {};
  if (timed->pool != nullptr) callbacks.runner = ThreadRunner::Run;
  callbacks.runner_data = timed->pool.get();
  starfocus_observer observer;
  starfocus_observer_init(&observer);
  observer.clock = [](void*) -> uint64_t { return Nanoseconds(); };
  if (task.timed) callbacks.observer = &observer;
  starfocus_set_callbacks(timed->engine, &callbacks);
  return UseTarget(task.target, timed->engine);
}

Error RunOnce(const Field& field, const Task& task, TimedEngine* timed, Elapsed* elapsed) {
  const starfocus_light_field rows = Rows(field.data, task.views);
  Image& out = timed->picture;
  const Stopwatch stopwatch;
  const starfocus_status status = test::RefocusRgb(timed->engine, &timed->params, &rows,
                                                   out.pixels.data(), out.stride(), &timed->report);
  *elapsed = stopwatch.Get();
  if (status == STARFOCUS_OK) return {};
  return Expected(field.name, "a light field that the engine refocuses",
                  starfocus_status_string(status));
}

}  // namespace starfocus::bench
