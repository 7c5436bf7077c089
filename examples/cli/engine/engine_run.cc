// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/engine/engine_run.h"

#include <algorithm>
#include <new>

#include "platform/clock.h"
#include "platform/file.h"
#include "platform/problem.h"

namespace starfocus {
namespace {

constexpr int kStreamRows = 8;  // pushed and pulled at a time

// The light field from row `first` on.
sf_light_field Rows(const LightField& light_field, int first) {
  sf_light_field rows = {};
  for (size_t i = 0; i < light_field.views.size(); ++i) {
    const Image& view = light_field.views[i];
    rows.views[i] = sf_image_rgb(view.row(first), view.stride());
  }
  const FloatMap& map = light_field.disparity;
  rows.depth = sf_depth_float(map.values.data() + size_t(first) * size_t(map.width),
                              sizeof(float) * size_t(map.width), map.width, map.height);
  if (!light_field.coverage.empty()) {
    rows.coverage = light_field.coverage.data() + size_t(first) * size_t(map.width);
    rows.coverage_stride = size_t(map.width);
  }
  return rows;
}

// What the engine could refuse, the program has looked at before; the address space alone limits
// sizes beyond that.
Error Outcome(const std::string& where, sf_status status, const sf_problem* problem) {
  if (status == SF_OK) return {};
  if (status == SF_ERROR_TOO_LARGE) return OutOfMemory(where, "refocus it");
  return Error::Internal(where, "a light field that the engine refocuses",
                         Describe(status, problem).text);
}

Error NoMemory(const std::string& where, size_t bytes) {
  return OutOfMemory(where, "refocus it (" + std::to_string(bytes) + " bytes at once)");
}

}  // namespace

void FreeAligned::operator()(void* memory) const {
  ::operator delete (memory, std::align_val_t{SF_ALIGNMENT});
}

sf_status MakeEngine(const sf_config& config, Workspace* workspace, size_t* bytes,
                     sf_engine** engine) {
  const sf_status status = sf_workspace_size(&config, bytes);
  if (status != SF_OK) return status;
  workspace->reset(::operator new (*bytes, std::align_val_t{SF_ALIGNMENT}));
  return sf_init(&config, workspace->get(), *bytes, engine);
}

EngineRun::EngineRun(int threads, int pictures)
    : runner_(threads), progress_("refocusing", pictures) {}

Error EngineRun::Start(const std::string& where, const EngineTask& task) {
  sf_config config = task.config;
  config.max_workers = task.threads;
  if (task.stream) config.features |= SF_FEATURE_STREAMING;
  sf_problem problem = {};
  config.problem = &problem;
  try {
    const sf_status status = MakeEngine(config, &workspace_, &workspace_bytes_, &engine_);
    return Outcome(where, status, &problem);
  } catch (const std::bad_alloc&) {
    return NoMemory(where, workspace_bytes_);
  }
}

Error EngineRun::Prepare(const std::string& where, const EngineTask& task) {
  sf_status status = sf_prepared_size(&task.config, &prepared_bytes_);
  if (status != SF_OK) return Outcome(where, status, nullptr);
  try {
    prepared_memory_.reset(::operator new (prepared_bytes_, std::align_val_t{SF_ALIGNMENT}));
  } catch (const std::bad_alloc&) {
    return NoMemory(where, prepared_bytes_);
  }
  status = SetCallbacks(task, false);
  if (status != SF_OK) return Outcome(where, status, sf_engine_problem(engine_));
  const sf_light_field rows = Rows(*task.light_field, 0);
  status = sf_prepare(engine_, &rows, prepared_memory_.get(), prepared_bytes_, &prepared_);
  return Outcome(where, status, sf_engine_problem(engine_));
}

Error EngineRun::Refocus(const std::string& where, const EngineTask& task, EngineResult* result) {
  return Run(where, task, nullptr, result);
}

Error EngineRun::RefocusAfter(const std::string& where, const EngineTask& task,
                              const LightField& before, const Image& picture,
                              EngineResult* result) {
  const sf_previous previous = {Rows(before, 0),
                                sf_image_rgb(picture.pixels.data(), picture.stride())};
  return Run(where, task, &previous, result);
}

sf_status EngineRun::SetCallbacks(const EngineTask& task, bool is_picture) {
  sf_callbacks callbacks = task.callbacks;
  callbacks.runner = ThreadRunner::Run;
  callbacks.runner_data = &runner_;
  if (is_picture) {
    callbacks.progress = PictureProgress::Tell;
    callbacks.progress_data = &progress_;
  }
  return sf_set_callbacks(engine_, &callbacks);
}

sf_status EngineRun::RunStream(const EngineTask& task, EngineResult* result) {
  Image* out = &result->picture;
  sf_status status = sf_stream_begin(engine_, &task.params);
  int pushed = 0, pulled = 0;
  while (status == SF_OK && pulled < out->height) {
    int32_t consumed = 0, written = 0;
    if (pushed < out->height) {
      const sf_light_field rows = Rows(*task.light_field, pushed);
      status =
          sf_stream_push(engine_, &rows, std::min(kStreamRows, out->height - pushed), &consumed);
      pushed += consumed;
    }
    if (status != SF_OK) break;
    const sf_image to = sf_image_rgb(out->row(pulled), out->stride());
    status = sf_stream_pull(engine_, &to, std::min(kStreamRows, out->height - pulled), &written,
                            &result->report);
    pulled += written;
    if (status == SF_OK && consumed == 0 && written == 0) return SF_ERROR_STATE;
  }
  return status;
}

Error EngineRun::Run(const std::string& where, const EngineTask& task, const sf_previous* previous,
                     EngineResult* result) {
  const sf_region& region = task.params.region;
  Image& out = result->picture;
  out = region.width > 0 ? Image(region.width, region.height)
                         : Image(task.config.width, task.config.height);
  result->workspace_bytes = workspace_bytes_;
  result->prepared_bytes = prepared_bytes_;
  const sf_light_field rows = Rows(*task.light_field, 0);
  const sf_image to = sf_image_rgb(out.pixels.data(), out.stride());
  sf_params params = task.params;
  params.previous = previous;
  sf_status status = SetCallbacks(task, true);
  if (status != SF_OK) return Outcome(where, status, sf_engine_problem(engine_));
  const double start = Seconds();
  if (task.stream) {
    status = RunStream(task, result);
  } else if (prepared_ != nullptr) {
    status = sf_refocus_prepared(engine_, &params, prepared_, &to, &result->report);
  } else {
    status = sf_refocus(engine_, &params, &rows, &to, &result->report);
  }
  result->seconds = Seconds() - start;
  return Outcome(where, status, sf_engine_problem(engine_));
}

}  // namespace starfocus
