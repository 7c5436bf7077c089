// SPDX-License-Identifier: Apache-2.0
// The streaming half of the C ABI: rows in, finished rows out, through the engine's line rings.
#include "lib/api/stream.h"

#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/base/features.h"
#include "lib/engine/layout.h"
#include "lib/engine/stripe.h"
#include "lib/source/extents.h"
#include "lib/source/light_field.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Input rows that the next stripe reads.
int32_t NeededRows(const EngineState& engine) {
  return Min(engine.config.height, engine.stream.next + engine.config.largest_block +
                                       LargestBorders(engine.config).streamed);
}

// Refocuses the next stripe, whose rows must have been pushed.
sf_status RefocusNext(EngineState* engine) {
  Stream& stream = engine->stream;
  Watch& watch = engine->crew.jobs.watch;
  watch.Begin(stream.finished, engine->config.height);
  const sf_status status = RefocusStripe(engine, stream.next);
  if (status != SF_OK) return status;
  stream.finished = FinishedRows(engine->config, stream.next);
  stream.next += engine->config.largest_block;
  watch.SetRows(stream.finished);
  return watch.Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

sf_status CheckCount(const EngineState& engine, int32_t rows, int32_t most) {
  Checker check(engine.config.problem);
  check.Need(engine.stream.active, SF_ERROR_STATE, {"stream"}, {"sf_stream_begin before"});
  check.In({"rows", double(rows)}, {"rows that are left", 0, double(most)});
  return check.status();
}

}  // namespace

sf_status CheckPush(const EngineState& engine, int32_t rows) {
  return CheckCount(engine, rows, engine.config.height - engine.stream.pushed);
}

sf_status CheckPull(const EngineState& engine, int32_t rows) {
  return CheckCount(engine, rows, INT32_MAX);
}

sf_status PushRows(const RowSource& source, int32_t rows, int32_t unit, EngineState* engine,
                   int32_t* consumed) {
  Stream& stream = engine->stream;
  const bool covers = source.coverage != nullptr;
  if (stream.pushed == 0) {
    stream.covers = covers;
    const Plane<uint8_t>& ring = engine->stripe.coverage.given;
    if (covers) {
      engine->pictures.windows[0].given_coverage = {ring.data, ring.stride, ring.rows, 0};
    }
  }
  Checker check(engine->config.problem);
  check.Need(covers == stream.covers, SF_ERROR_STATE, {"coverage"}, {"in all rows or in none"});
  if (check.status() != SF_OK) return check.status();
  while (*consumed < rows && stream.pushed < NeededRows(*engine)) {
    const int32_t some = Min(unit, rows - *consumed);
    const sf_report report = engine->report;
    // Both rows of a pair, or none.
    for (int32_t k = 0; k < some; ++k) {
      const sf_status status = CopyRow(source, stream.pushed + k, engine);
      if (status == SF_OK) continue;
      engine->report = report;
      return status;
    }
    stream.pushed += some;
    *consumed += some;
  }
  return SF_OK;
}

sf_status PullRows(const RowSink& sink, int32_t rows, EngineState* engine, int32_t* written) {
  Stream& stream = engine->stream;
  while (*written < rows && stream.written < engine->config.height) {
    if (stream.written == stream.finished) {
      if (stream.pushed < NeededRows(*engine)) break;
      const sf_status status = RefocusNext(engine);
      if (status != SF_OK) return status;
    }
    const int32_t some = Min(rows - *written, stream.finished - stream.written);
    const sf_status status =
        sink.store(sink.self, {stream.written, stream.written + some},
                   BufferRows(*engine, stream.next - engine->config.largest_block), engine);
    if (status != SF_OK) return status;
    stream.written += some;
    *written += some;
  }
  return SF_OK;
}

}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_stream_begin(sf_engine* engine, const sf_params* params) {
  sf_params full;
  sf_status status = starfocus::EnterCall(engine, {{"params", params}}, params, &full);
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  status = starfocus::CheckParams(e.config, full);
  if (status != SF_OK) return status;
  starfocus::Checker check(&e.problem);
  check.Need(starfocus::Has(e.config.features, SF_FEATURE_STREAMING), SF_ERROR_FEATURE,
             {"features", double(e.config.features)}, {"SF_FEATURE_STREAMING"});
  check.Need(starfocus::IsWhole(full.region), SF_ERROR_RANGE, {"region"}, {"all 0"});
  if (check.status() != SF_OK) return check.status();
  e.stream = starfocus::Stream();
  e.crew.jobs.watch.Begin(0, e.config.height);
  status = starfocus::SetLens(full, &e);
  if (status != SF_OK) return status;
  starfocus::SetPlanes(e.config, *e.kernels, e.rings, &e.pictures);
  e.stream.active = true;
  return SF_OK;
}

sf_status sf_stream_push(sf_engine* engine, const sf_light_field* light_field, int32_t rows,
                         int32_t* consumed) {
  if (consumed != nullptr) *consumed = 0;
  sf_status status =
      starfocus::EnterEngine(engine, {{"light_field", light_field}, {"consumed", consumed}});
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  status = starfocus::CheckPush(e, rows);
  if (status == SF_OK) status = starfocus::CheckLightField(e.config, *light_field);
  if (status != SF_OK) return status;
  const starfocus::LightFieldRows pushed(*light_field, e.stream.pushed, e);
  return starfocus::PushRows(pushed.Source(), rows, 1, &e, consumed);
}

sf_status sf_stream_pull(sf_engine* engine, uint8_t* out, size_t out_stride, int32_t rows,
                         int32_t* written, sf_report* report) {
  if (written != nullptr) *written = 0;
  sf_status status = starfocus::EnterEngine(engine, {{"written", written}});
  if (status != SF_OK) return status;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  status = starfocus::CheckPull(e, rows);
  const int32_t width = e.config.width, left = e.config.height - e.stream.written;
  if (status == SF_OK) {
    status = starfocus::CheckOutput(e.config, {0, 0, width, e.config.height}, out, out_stride);
  }
  if (status != SF_OK) return status;
  const int32_t most = starfocus::Min(rows, left);
  status = starfocus::CheckApart(
      starfocus::ExtentOf(out, out_stride, most, 3 * static_cast<size_t>(width)),
      starfocus::MemoryOf(e, nullptr), "out", &e.problem);
  if (status != SF_OK) return status;
  const starfocus::Picture picture = {out, out_stride, {0, e.stream.written, width, left}};
  status = starfocus::PullRows(starfocus::SinkOf(picture), rows, &e, written);
  if (status == SF_OK && report != nullptr) *report = e.report;
  return status;
}
