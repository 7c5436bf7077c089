// SPDX-License-Identifier: Apache-2.0
#include "examples/cli/engine_run.h"

#include <algorithm>

#include "platform/clock.h"
#include "platform/deep_image.h"
#include "platform/file.h"
#include "platform/problem.h"
#include "starfocus/experimental.h"
#include "starfocus/starfocus.hpp"

namespace starfocus {

namespace {

// Reads coefficient `name` of the object, in picoseconds.
Result<uint32_t> ReadCoefficient(const std::string& path, const JsonObject& object,
                                 const std::string& name) {
  const auto expected = [&](const std::string& found) {
    return Expected(
        path,
        "timing." + name + " as a whole number from 0 to " + std::to_string(STARFOCUS_MAX_TIMING),
        found);
  };
  for (const JsonMember& member : object.members) {
    if (member.name != name) continue;
    if (!member.is_whole || member.whole > STARFOCUS_MAX_TIMING) {
      return expected(member.text.substr(0, 60));
    }
    return static_cast<uint32_t>(member.whole);
  }
  return expected("none");
}

}  // namespace

Json TimingJson(const starfocus_timing& timing) {
  Json json;
  for (const TimingTerm& term : kTimingTerms) json.Set(term.name, timing.*term.coefficient);
  return json;
}

Result<starfocus_timing> ReadTiming(const std::string& path) {
  const Result<Bytes> bytes = ReadSmallFile(path);
  if (!bytes) return bytes.error();
  const JsonObject object = ReadJsonObject(*bytes, "timing");
  if (!object.is_json) return Expected(path, "a JSON file", "other text");
  if (!object.is_there) {
    return Expected(path, "an object \"timing\", as written by starfocus-lab calibrate", "none");
  }
  starfocus_timing timing = {};
  for (const TimingTerm& term : kTimingTerms) {
    Error error = ReadCoefficient(path, object, term.name).MoveTo(&(timing.*term.coefficient));
    if (error) return error;
  }
  for (const JsonMember& member : object.members) {
    bool known = false;
    for (const TimingTerm& term : kTimingTerms) known = known || member.name == term.name;
    if (!known)
      return Expected(path, "only known coefficients", "timing." + member.name.substr(0, 60));
  }
  return timing;
}

namespace {

constexpr int kStreamRows = 8;  // number of rows that are pushed or pulled at a time

// Converts a status to an error. The program has already checked all arguments, so the only
// expected cause is insufficient memory or address space.
Error Outcome(const std::string& where, starfocus_status status, const starfocus_problem* problem,
              size_t bytes = 0) {
  if (status == STARFOCUS_OK) return {};
  if (status == STARFOCUS_ERROR_TOO_LARGE) return OutOfMemory(where, "refocus it");
  if (status == STARFOCUS_ERROR_MEMORY) {
    return OutOfMemory(where, "allocate " + std::to_string(bytes) + " bytes to refocus it");
  }
  return Error::Internal(where, "a light field that the engine accepts",
                         Describe(status, problem).text);
}

}  // namespace

EngineRun::EngineRun(int threads, int pictures)
    : runner_(threads), progress_("refocusing", pictures) {}

Error EngineRun::Start(const std::string& where, const EngineTask& task) {
  starfocus::Config config = task.config;
  config.max_workers = task.threads;
  if (task.stream) config.features |= STARFOCUS_FEATURE_STREAMING;
  starfocus_problem problem = {};
  const starfocus_status status = engine_.Init(config, &problem);
  starfocus_workspace_size(&config, &workspace_bytes_, nullptr);
  return Outcome(where, status, &problem, workspace_bytes_);
}

Error EngineRun::Prepare(const std::string& where, const EngineTask& task) {
  starfocus_status status = SetCallbacks(task, false);
  if (status == STARFOCUS_OK)
    status = engine_.Prepare(EngineRows(*task.light_field, 0, task.deep_views));
  starfocus_prepared_size(&task.config, &prepared_bytes_, nullptr);
  return Outcome(where, status, engine_.problem(), prepared_bytes_);
}

Result<EngineResult> EngineRun::Refocus(const std::string& where, const EngineTask& task) {
  EngineResult result;
  MakePicture(task, &result);
  if (Error error = Run(where, task, nullptr, &result)) return error;
  return result;
}

void EngineRun::MakePicture(const EngineTask& task, EngineResult* result) {
  const starfocus_region& region = task.params.region;
  const bool whole = region.width == 0;
  const int width = whole ? task.config.width : region.width;
  const int height = whole ? task.config.height : region.height;
  if (task.planar_picture) {
    result->planar = task.planar;
    result->planar.width = width;
    result->planar.height = height;
    result->planar.Allocate();
    return;
  }
  if (!task.deep_picture) {
    result->picture = Image(width, height);
    return;
  }
  const std::vector<DeepImage>& views = task.light_field->deep;
  const DeepImage codes;  // of 16 bits
  const DeepImage& first = views.empty() ? codes : views[0];
  result->deep = DeepImage(width, height, first.channels);
  result->deep.is_half = first.is_half;
  result->deep.transfer = first.transfer;
  result->deep.bits = first.bits;
}

Error EngineRun::RefocusRows(const std::string& where, const EngineTask& task, RowGate* rows,
                             EngineResult* result) {
  // A stream reports rows before it has copied the rows into the picture.
  rows_ = task.stream ? nullptr : rows;
  const Error error = Run(where, task, nullptr, result);
  rows_ = nullptr;
  return error;
}

Result<EngineResult> EngineRun::RefocusAfter(const std::string& where, const EngineTask& task,
                                             const LightField& before, const Image& picture) {
  const starfocus_light_field rows = EngineRows(before);
  const starfocus_image image = starfocus_image_rgb(picture.pixels.data(), picture.stride());
  const starfocus_previous previous = {sizeof previous, &rows, &image};
  EngineResult result;
  MakePicture(task, &result);
  if (Error error = Run(where, task, &previous, &result)) return error;
  return result;
}

int EngineRun::Tell(void* self, int32_t rows_done, int32_t rows) {
  EngineRun* run = static_cast<EngineRun*>(self);
  if (run->rows_ != nullptr) run->rows_->Finish(rows_done);
  return PictureProgress::Tell(&run->progress_, rows_done, rows);
}

starfocus_status EngineRun::SetCallbacks(const EngineTask& task, bool is_picture) {
  starfocus_callbacks callbacks = {};
  callbacks.observer = &task.observer;
  callbacks.runner = ThreadRunner::Run;
  callbacks.runner_data = &runner_;
  if (is_picture) {
    callbacks.progress = Tell;
    callbacks.progress_data = this;
  }
  return engine_.SetCallbacks(callbacks);
}

namespace {

// Returns the rows from `first` on of the picture that the task computes. For a
// picture in YUV, `first` must be 0.
starfocus_image OutputRows(const EngineTask& task, const EngineResult& result, int first) {
  if (task.planar_picture) return EngineImage(result.planar);
  if (task.deep_picture) return EngineImage(result.deep, first);
  return starfocus_image_rgb(result.picture.row(first), result.picture.stride());
}

}  // namespace

starfocus_status EngineRun::RunStream(const EngineTask& task, EngineResult* result) {
  const int height = task.deep_picture ? result->deep.height : result->picture.height;
  starfocus_status status = engine_.StreamBegin(task.params);
  int pushed = 0, pulled = 0;
  while (status == STARFOCUS_OK && pulled < height) {
    int32_t consumed = 0, written = 0;
    if (pushed < height) {
      status = engine_.StreamPush(EngineRows(*task.light_field, pushed, task.deep_views),
                                  std::min(kStreamRows, height - pushed), &consumed);
      pushed += consumed;
    }
    if (status != STARFOCUS_OK) break;
    const starfocus_image to = OutputRows(task, *result, pulled);
    status =
        engine_.StreamPull(to, std::min(kStreamRows, height - pulled), &written, &result->report);
    pulled += written;
    if (status == STARFOCUS_OK && consumed == 0 && written == 0) return STARFOCUS_ERROR_STATE;
  }
  return status;
}

Error EngineRun::Run(const std::string& where, const EngineTask& task,
                     const starfocus_previous* previous, EngineResult* result) {
  result->workspace_bytes = workspace_bytes_;
  result->prepared_bytes = prepared_bytes_;
  const starfocus_image to = OutputRows(task, *result, 0);
  starfocus::Params params = task.params;
  params.previous = previous;
  starfocus_status status = SetCallbacks(task, true);
  if (status != STARFOCUS_OK) return Outcome(where, status, engine_.problem());
  result->report.layers = result->layers;
  const double start = Seconds();
  if (task.stream) {
    status = RunStream(task, result);
  } else if (prepared_bytes_ > 0) {
    status = engine_.RefocusPrepared(params, to, &result->report);
  } else {
    status = engine_.Refocus(params, EngineRows(*task.light_field, 0, task.deep_views), to,
                             &result->report);
  }
  result->report.layers = nullptr;  // the result may be moved
  result->seconds = Seconds() - start;
  if (task.deep_picture) result->picture = ToImage(result->deep);
  return Outcome(where, status, engine_.problem());
}

}  // namespace starfocus
