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

// What the engine could refuse, the program has looked at before; the address space alone limits
// sizes beyond that.
Error Outcome(const std::string& where, starfocus_status status, const starfocus_problem* problem) {
  if (status == STARFOCUS_OK) return {};
  if (status == STARFOCUS_ERROR_TOO_LARGE) return OutOfMemory(where, "refocus it");
  return Error::Internal(where, "a light field that the engine refocuses",
                         Describe(status, problem).text);
}

Error NoMemory(const std::string& where, size_t bytes) {
  return OutOfMemory(where, "refocus it (" + std::to_string(bytes) + " bytes at once)");
}

}  // namespace

void FreeAligned::operator()(void* memory) const {
  ::operator delete (memory, std::align_val_t{STARFOCUS_ALIGNMENT});
}

starfocus_status MakeEngine(const starfocus_config& config, Workspace* workspace, size_t* bytes,
                            starfocus_engine** engine) {
  const starfocus_status status = starfocus_workspace_size(&config, bytes);
  if (status != STARFOCUS_OK) return status;
  workspace->reset(::operator new (*bytes, std::align_val_t{STARFOCUS_ALIGNMENT}));
  return starfocus_init(&config, workspace->get(), *bytes, engine);
}

EngineRun::EngineRun(int threads, int pictures)
    : runner_(threads), progress_("refocusing", pictures) {}

Error EngineRun::Start(const std::string& where, const EngineTask& task) {
  starfocus_config config = task.config;
  config.max_workers = task.threads;
  if (task.stream) config.features |= STARFOCUS_FEATURE_STREAMING;
  starfocus_problem problem = {};
  config.problem = &problem;
  try {
    const starfocus_status status = MakeEngine(config, &workspace_, &workspace_bytes_, &engine_);
    return Outcome(where, status, &problem);
  } catch (const std::bad_alloc&) {
    return NoMemory(where, workspace_bytes_);
  }
}

Error EngineRun::Prepare(const std::string& where, const EngineTask& task) {
  starfocus_status status = starfocus_prepared_size(&task.config, &prepared_bytes_);
  if (status != STARFOCUS_OK) return Outcome(where, status, nullptr);
  try {
    prepared_memory_.reset(::operator new (prepared_bytes_, std::align_val_t{STARFOCUS_ALIGNMENT}));
  } catch (const std::bad_alloc&) {
    return NoMemory(where, prepared_bytes_);
  }
  status = SetCallbacks(task, false);
  if (status != STARFOCUS_OK) return Outcome(where, status, starfocus_engine_problem(engine_));
  const starfocus_light_field rows = EngineRows(*task.light_field);
  status = starfocus_prepare(engine_, &rows, prepared_memory_.get(), prepared_bytes_, &prepared_);
  return Outcome(where, status, starfocus_engine_problem(engine_));
}

Result<EngineResult> EngineRun::Refocus(const std::string& where, const EngineTask& task) {
  return Run(where, task, nullptr);
}

Result<EngineResult> EngineRun::RefocusAfter(const std::string& where, const EngineTask& task,
                                             const LightField& before, const Image& picture) {
  const starfocus_previous previous = {
      EngineRows(before), starfocus_image_rgb(picture.pixels.data(), picture.stride())};
  return Run(where, task, &previous);
}

starfocus_status EngineRun::SetCallbacks(const EngineTask& task, bool is_picture) {
  starfocus_callbacks callbacks = task.callbacks;
  callbacks.runner = ThreadRunner::Run;
  callbacks.runner_data = &runner_;
  if (is_picture) {
    callbacks.progress = PictureProgress::Tell;
    callbacks.progress_data = &progress_;
  }
  return starfocus_set_callbacks(engine_, &callbacks);
}

starfocus_status EngineRun::RunStream(const EngineTask& task, EngineResult* result) {
  Image* out = &result->picture;
  starfocus_status status = starfocus_stream_begin(engine_, &task.params);
  int pushed = 0, pulled = 0;
  while (status == STARFOCUS_OK && pulled < out->height) {
    int32_t consumed = 0, written = 0;
    if (pushed < out->height) {
      const starfocus_light_field rows = EngineRows(*task.light_field, pushed);
      status = starfocus_stream_push(engine_, &rows, std::min(kStreamRows, out->height - pushed),
                                     &consumed);
      pushed += consumed;
    }
    if (status != STARFOCUS_OK) break;
    const starfocus_image to = starfocus_image_rgb(out->row(pulled), out->stride());
    status = starfocus_stream_pull(engine_, &to, std::min(kStreamRows, out->height - pulled),
                                   &written, &result->report);
    pulled += written;
    if (status == STARFOCUS_OK && consumed == 0 && written == 0) return STARFOCUS_ERROR_STATE;
  }
  return status;
}

Result<EngineResult> EngineRun::Run(const std::string& where, const EngineTask& task,
                                    const starfocus_previous* previous) {
  const starfocus_region& region = task.params.region;
  EngineResult result;
  Image& out = result.picture;
  out = region.width > 0 ? Image(region.width, region.height)
                         : Image(task.config.width, task.config.height);
  result.workspace_bytes = workspace_bytes_;
  result.prepared_bytes = prepared_bytes_;
  const starfocus_light_field rows = EngineRows(*task.light_field);
  const starfocus_image to = starfocus_image_rgb(out.pixels.data(), out.stride());
  starfocus_params params = task.params;
  params.previous = previous;
  starfocus_status status = SetCallbacks(task, true);
  if (status != STARFOCUS_OK) return Outcome(where, status, starfocus_engine_problem(engine_));
  const double start = Seconds();
  if (task.stream) {
    status = RunStream(task, &result);
  } else if (prepared_ != nullptr) {
    status = starfocus_refocus_prepared(engine_, &params, prepared_, &to, &result.report);
  } else {
    status = starfocus_refocus(engine_, &params, &rows, &to, &result.report);
  }
  result.seconds = Seconds() - start;
  if (Error error = Outcome(where, status, starfocus_engine_problem(engine_))) return error;
  return result;
}

}  // namespace starfocus
