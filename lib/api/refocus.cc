// SPDX-License-Identifier: Apache-2.0
// The C ABI for whole pictures, regions of them, and previews.
#include "lib/api/call.h"
#include "lib/api/preview.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/base/rows.h"
#include "lib/source/light_field.h"
#include "lib/source/picture_output.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// A refocusing as the C ABI asks for it; prepared may be null.
struct Request {
  const sf_params& params;
  const sf_light_field& light_field;
  const Prepared* prepared;
  const sf_image& out;
};

// Checks the frame before, if there is one: it can be compared only in place.
sf_status CheckPrevious(const sf_config& config, const Request& request, const PictureSize& size) {
  const sf_previous* const previous = request.params.previous;
  if (previous == nullptr) return SF_OK;
  Checker check(config.problem);
  check.Need(request.prepared == nullptr, SF_ERROR_RANGE, {"previous"},
             {"null for a prepared light field"});
  check.Need(IsInPlace(request.out) && IsInPlace(previous->out), SF_ERROR_FEATURE,
             {"previous.out.format", double(previous->out.format)},
             {"SF_FORMAT_RGB without gaps, as that of out"});
  sf_status status = check.status();
  for (const sf_light_field* field : {&request.light_field, &previous->light_field}) {
    if (status == SF_OK) status = CheckLightField(config, *field);
    if (status == SF_OK) status = CheckInPlace(*field, config.views, config.problem);
    if (status != SF_OK) break;
    status = CheckInPlace(field->depth, {config.width, config.height}, config.problem);
  }
  return status == SF_OK ? CheckOutput(config, previous->out, size) : status;
}

// All that `out` may not overlap: all that is read, and the engine.
Extents ReadBy(const Request& request, const PictureSize& size, const EngineState& engine) {
  Extents read = MemoryOf(engine, request.prepared);
  AddLightField(engine.config, request.light_field, &read);
  if (const sf_previous* const previous = request.params.previous) {
    AddLightField(engine.config, previous->light_field, &read);
    AddImage(previous->out, size, &read);
  }
  return read;
}

// What the picture before can be compared with: both light fields have coverage, or none has.
const sf_previous* ComparableOf(const Request& request) {
  const sf_previous* const previous = request.params.previous;
  if (previous == nullptr) return nullptr;
  const bool same =
      (previous->light_field.coverage == nullptr) == (request.light_field.coverage == nullptr);
  return same ? previous : nullptr;
}

sf_status CheckRequest(const Request& request, const EngineState& engine) {
  const sf_config& config = engine.config;
  sf_status status = CheckCall(config, request.params, request.prepared);
  if (status == SF_OK) status = CheckLightField(config, request.light_field);
  if (status != SF_OK) return status;
  const Rect rect = RegionOf(config, request.params);
  const PictureSize size = {rect.width, rect.height};
  status = CheckOutput(config, request.out, size);
  if (status == SF_OK) status = CheckPrevious(config, request, size);
  if (status != SF_OK) return status;
  return CheckOutputApart(request.out, size, ReadBy(request, size, engine), config.problem);
}

sf_status Refocus(const Request& request, EngineState* engine, sf_report* report) {
  const sf_status status = CheckRequest(request, *engine);
  if (status != SF_OK) return status;
  LightField field;
  MakeLightField(request.light_field, 0, engine, &field);
  UseLightField(field, engine);
  const sf_previous* const previous = ComparableOf(request);
  const PictureOutput out = {field.kernels, PlanesOf<uint8_t>(request.out),
                             RegionOf(engine->config, request.params), AlphaOf(field.views[0]),
                             previous == nullptr ? nullptr : &previous->out};
  Call call = {request.params, SourceOf(field), SinkOf(out), request.prepared};
  if (request.prepared != nullptr) call.source.map = nullptr;
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
                     const sf_image* out, sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"light_field", light_field}, {"out", out}}, params, &full);
  if (status != SF_OK) return status;
  auto& e = *reinterpret_cast<EngineState*>(engine);
  if (full.preview_shift != 0) {
    return starfocus::Refuse(SF_ERROR_RANGE, {"preview_shift", double(full.preview_shift)},
                             {"0 without a prepared light field", 0, 0}, &e.problem);
  }
  return starfocus::Refocus({full, *light_field, nullptr, *out}, &e, report);
}

sf_status sf_refocus_prepared(sf_engine* engine, const sf_params* params,
                              const sf_prepared* prepared, const sf_image* out, sf_report* report) {
  sf_params full;
  const sf_status status = starfocus::EnterCall(
      engine, {{"params", params}, {"prepared", prepared}, {"out", out}}, params, &full);
  if (status != SF_OK) return status;
  auto& e = *reinterpret_cast<EngineState*>(engine);
  const auto& p = *reinterpret_cast<const starfocus::Prepared*>(prepared);
  if (full.preview_shift != 0) {
    return starfocus::RefocusPreview({full, p, full.preview_shift}, *out, &e, report);
  }
  return starfocus::Refocus({full, p.light_field, &p, *out}, &e, report);
}
