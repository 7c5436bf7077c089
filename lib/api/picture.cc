// SPDX-License-Identifier: Apache-2.0
// The C ABI for whole RGB pictures and regions of them.
#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/source/light_field.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// A refocusing as the C ABI asks for it; prepared and previous may be null.
struct Request {
  const sf_params& params;
  const sf_light_field& light_field;
  const Prepared* prepared;
  const sf_previous* previous;
  uint8_t* out;
  size_t out_stride;
};

sf_status CheckPrevious(const sf_config& config, const sf_previous& previous, const Rect& rect) {
  const sf_status status = CheckLightField(config, previous.light_field);
  if (status != SF_OK) return status;
  return CheckOutput(config, rect, previous.out, previous.out_stride);
}

// Checks what `out` may not overlap: all that is read, and the engine.
sf_status CheckOverlap(const Request& request, const Rect& rect, const EngineState& engine) {
  const size_t row_bytes = 3 * static_cast<size_t>(rect.width);
  Extents read = MemoryOf(engine, request.prepared);
  read.AddLightField(engine.config, request.light_field);
  if (const sf_previous* const previous = request.previous) {
    read.AddLightField(engine.config, previous->light_field);
    read.AddRows(previous->out, previous->out_stride, rect.height, row_bytes);
  }
  const Extent out = ExtentOf(request.out, request.out_stride, rect.height, row_bytes);
  return CheckApart(out, read, "out", engine.config.problem);
}

// What the picture before can be compared with: both light fields have coverage, or none has.
const sf_previous* ComparableOf(const Request& request) {
  if (request.previous == nullptr) return nullptr;
  const sf_light_field& before = request.previous->light_field;
  const bool same = (before.coverage == nullptr) == (request.light_field.coverage == nullptr);
  return same ? request.previous : nullptr;
}

sf_status Refocus(const Request& request, EngineState* engine, sf_report* report) {
  const sf_config& config = engine->config;
  sf_status status = CheckCall(config, request.params, request.prepared);
  if (status == SF_OK) status = CheckLightField(config, request.light_field);
  const Rect rect = RegionOf(config, request.params);
  if (status == SF_OK) status = CheckOutput(config, rect, request.out, request.out_stride);
  if (status == SF_OK && request.previous != nullptr) {
    status = CheckPrevious(config, *request.previous, rect);
  }
  if (status == SF_OK) status = CheckOverlap(request, rect, *engine);
  if (status != SF_OK) return status;
  const LightFieldRows rows(request.light_field, 0, *engine);
  rows.Use(engine);
  const sf_previous* const previous = ComparableOf(request);
  const Picture picture = {request.out, request.out_stride, rect, previous};
  Call call = {request.params, {}, SinkOf(picture), request.prepared};
  if (request.prepared == nullptr) call.source = rows.Source();
  if (previous != nullptr) {
    call.before = &previous->light_field;
    call.now = &request.light_field;
  }
  return RunCall(call, engine, report);
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus(sf_engine* engine, const sf_params* params, const sf_light_field* light_field,
                     uint8_t* out, size_t out_stride, sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"light_field", light_field}}, params, &full);
  if (status != SF_OK) return status;
  return starfocus::Refocus({full, *light_field, nullptr, nullptr, out, out_stride},
                            reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_after(sf_engine* engine, const sf_params* params,
                           const sf_light_field* light_field, const sf_previous* previous,
                           uint8_t* out, size_t out_stride, sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"light_field", light_field}, {"previous", previous}}, params,
      &full);
  if (status != SF_OK) return status;
  return starfocus::Refocus({full, *light_field, nullptr, previous, out, out_stride},
                            reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_prepared(sf_engine* engine, const sf_params* params,
                              const sf_prepared* prepared, uint8_t* out, size_t out_stride,
                              sf_report* report) {
  sf_params full;
  const sf_status status =
      starfocus::EnterCall(engine, {{"params", params}, {"prepared", prepared}}, params, &full);
  if (status != SF_OK) return status;
  const auto* p = reinterpret_cast<const starfocus::Prepared*>(prepared);
  if (p->images != nullptr) {
    return starfocus::Refuse(SF_ERROR_PREPARED, {"prepared"}, {"of sf_prepare"},
                             &reinterpret_cast<EngineState*>(engine)->problem);
  }
  return starfocus::Refocus({full, p->light_field, p, nullptr, out, out_stride},
                            reinterpret_cast<EngineState*>(engine), report);
}
