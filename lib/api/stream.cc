// SPDX-License-Identifier: Apache-2.0
// The streaming half of the C ABI: rows in, finished rows out, through the engine's line rings.
#include "lib/api/stream.h"

#include <cstring>

#include "lib/api/light_field.h"
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/layout.h"
#include "lib/engine/lens.h"
#include "lib/engine/stripe.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

sf_status PushRow(const sf_light_field& light_field, int32_t row, EngineState* engine) {
  const size_t offset = static_cast<size_t>(row);
  int32_t unknown = 0;
  const sf_status status =
      ReadDisparity(DisparityRow(light_field, row), engine->stream.pushed, engine, &unknown);
  if (status != SF_OK) return status;
  engine->report.unknown_pixels += static_cast<uint64_t>(unknown);
  for (int view = 0; view < engine->config.views; ++view) {
    const sf_plane& plane = light_field.views[view];
    std::memcpy(engine->rings[view].Row(engine->stream.pushed), plane.data + offset * plane.stride,
                3 * static_cast<size_t>(engine->config.width));
  }
  const Plane<uint8_t>& alpha = engine->images.alpha;
  if (alpha.data != nullptr) std::memset(alpha.Row(engine->stream.pushed), 255, alpha.stride);
  ++engine->stream.pushed;
  return SF_OK;
}

// Copies finished rows out of the stripe buffer.
int32_t CopyRows(EngineState* engine, uint8_t* out, size_t out_stride, int32_t rows) {
  Stream& stream = engine->stream;
  const Plane<uint8_t> from = BufferRows(*engine, stream.next - engine->config.largest_block);
  int32_t copied = 0;
  for (; copied < rows && StripeWaiting(*engine); ++copied, ++stream.written) {
    std::memcpy(out + static_cast<size_t>(copied) * out_stride, from.Row(stream.written),
                from.stride);
  }
  return copied;
}

}  // namespace

int32_t NeededRows(const EngineState& engine) {
  return Min(engine.config.height,
             engine.stream.next + engine.config.largest_block + StreamReach(engine.config));
}

bool StripeWaiting(const EngineState& engine) {
  return engine.stream.written < engine.stream.finished;
}

sf_status RefocusNext(EngineState* engine, const Runner& runner) {
  Stream& stream = engine->stream;
  const sf_params& params = engine->lens.params;
  Watch& watch = engine->crew.jobs.watch;
  watch.Begin(params.progress, params.progress_data, stream.finished, engine->config.height);
  const sf_status status = RefocusIntoBuffer(engine, stream.next, runner);
  if (status != SF_OK) return status;
  stream.finished = FinishedRows(engine->config, stream.next);
  stream.next += engine->config.largest_block;
  watch.SetRows(stream.finished);
  return watch.Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_stream_begin(sf_engine* engine, const sf_params* params) {
  if (engine == nullptr || params == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  sf_status status = starfocus::CheckParams(e.config, *params);
  if (status != SF_OK) return status;
  if (e.config.streaming == 0) return SF_ERROR_STATE;
  if (!starfocus::IsWhole(params->region)) return SF_ERROR_REGION;
  e.stream = starfocus::Stream();
  e.crew.jobs.watch.Begin(params->progress, params->progress_data, 0, e.config.height);
  status = starfocus::SetLens(*params, &e);
  if (status != SF_OK) return status;
  starfocus::Plane<const uint8_t> views[starfocus::kMaxViews];
  for (int view = 0; view < e.config.views; ++view) {
    views[view] = {e.rings[view].data, e.rings[view].stride, e.rings[view].rows, 0};
  }
  starfocus::SetPlanes(e.config, *e.kernels, views, &e.pictures);
  e.stream.active = true;
  return SF_OK;
}

sf_status sf_stream_push(sf_engine* engine, const sf_light_field* light_field, int32_t rows,
                         int32_t* consumed) {
  if (consumed == nullptr) return SF_ERROR_NULL;
  *consumed = 0;
  if (engine == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  if (!e.stream.active) return SF_ERROR_STATE;
  if (rows < 0 || rows > e.config.height - e.stream.pushed) return SF_ERROR_COUNT;
  const sf_status status = starfocus::CheckLightField(e.config, *light_field);
  if (status != SF_OK) return status;
  while (*consumed < rows && e.stream.pushed < starfocus::NeededRows(e)) {
    const sf_status row_status = starfocus::PushRow(*light_field, *consumed, &e);
    if (row_status != SF_OK) return row_status;
    ++*consumed;
  }
  return SF_OK;
}

sf_status sf_stream_pull(sf_engine* engine, uint8_t* out, size_t out_stride, int32_t rows,
                         sf_runner runner, void* runner_data, int32_t* written, sf_report* report) {
  if (written == nullptr) return SF_ERROR_NULL;
  *written = 0;
  if (engine == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  if (!e.stream.active) return SF_ERROR_STATE;
  if (rows < 0) return SF_ERROR_COUNT;
  sf_status status = starfocus::CheckOutput(e.config.width, e.config.height, out, out_stride);
  if (status != SF_OK) return status;
  const int32_t most = starfocus::Min(rows, e.config.height - e.stream.written);
  if (starfocus::Overlaps(
          starfocus::Workspace(e),
          starfocus::ExtentOf(out, out_stride, most, 3 * static_cast<size_t>(e.config.width)))) {
    return SF_ERROR_OVERLAP;
  }
  while (*written < rows && e.stream.written < e.config.height) {
    if (!starfocus::StripeWaiting(e)) {
      if (e.stream.pushed < starfocus::NeededRows(e)) break;
      status = starfocus::RefocusNext(&e, {runner, runner_data});
      if (status != SF_OK) return status;
    }
    *written += starfocus::CopyRows(&e, out + static_cast<size_t>(*written) * out_stride,
                                    out_stride, rows - *written);
  }
  if (report != nullptr) *report = e.report;
  return SF_OK;
}
