#include "engine_run.h"

#include <algorithm>
#include <new>

#include "platform/clock.h"
#include "platform/file.h"
#include "platform/progress.h"
#include "platform/runner.h"

namespace starfocus {
namespace {

constexpr int kStreamRows = 8;  // pushed and pulled at a time

// The thread pool with a progress line: every batch of jobs is a step.
struct ShownRunner {
  ThreadRunner pool;
  Progress progress;

  static int Run(void* data, sf_job job, void* job_data, int32_t count) {
    ShownRunner* self = static_cast<ShownRunner*>(data);
    const int status = ThreadRunner::Run(&self->pool, job, job_data, count);
    self->progress.Step();
    return status;
  }
};

// The light field from row `first` on.
sf_light_field Rows(const LightField& light_field, int first) {
  sf_light_field rows = {};
  for (size_t i = 0; i < light_field.views.size(); ++i) {
    const Image& view = light_field.views[i];
    rows.views[i] = {view.row(first), view.stride()};
  }
  const FloatMap& map = light_field.disparity;
  rows.disparity = map.values.data() + size_t(first) * size_t(map.width);
  rows.disparity_stride = sizeof(float) * size_t(map.width);
  return rows;
}

sf_status RunStream(sf_engine* engine, const EngineTask& task, ShownRunner* runner,
                    EngineResult* result) {
  Image* out = &result->picture;
  sf_status status = sf_stream_begin(engine, &task.params);
  int pushed = 0, pulled = 0;
  while (status == SF_OK && pulled < out->height) {
    int32_t consumed = 0, written = 0;
    if (pushed < out->height) {
      const sf_light_field rows = Rows(*task.light_field, pushed);
      status =
          sf_stream_push(engine, &rows, std::min(kStreamRows, out->height - pushed), &consumed);
      pushed += consumed;
    }
    if (status != SF_OK) break;
    status = sf_stream_pull(engine, out->row(pulled), out->stride(),
                            std::min(kStreamRows, out->height - pulled), ShownRunner::Run, runner,
                            &written, &result->report);
    pulled += written;
    if (status == SF_OK && consumed == 0 && written == 0) return SF_ERROR_STATE;
  }
  return status;
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

std::string RunEngine(const std::string& where, EngineTask task, EngineResult* result) {
  ShownRunner runner = {ThreadRunner(task.threads), Progress("refocusing", 0)};
  task.config.max_workers = task.threads;
  task.config.streaming = task.stream ? 1 : 0;
  Workspace workspace;
  sf_engine* engine = nullptr;
  sf_status status = MakeEngine(task.config, &workspace, &result->workspace_bytes, &engine);
  if (status == SF_OK) {
    Image& out = result->picture;
    const sf_region& region = task.params.region;
    out = region.width > 0 ? Image(region.width, region.height)
                           : Image(task.config.width, task.config.height);
    const sf_light_field rows = Rows(*task.light_field, 0);
    const double start = Seconds();
    status = task.stream ? RunStream(engine, task, &runner, result)
                         : sf_refocus(engine, &task.params, &rows, out.pixels.data(), out.stride(),
                                      ShownRunner::Run, &runner, &result->report);
    result->seconds = Seconds() - start;
  }
  if (status == SF_OK) return "";
  return Expected(where, "a light field that the engine refocuses", sf_status_string(status));
}

}  // namespace starfocus
