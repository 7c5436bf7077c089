// SPDX-License-Identifier: Apache-2.0
// C API: refocuses whole pictures, regions and previews.

#include "lib/api/call.h"
#include "lib/api/preview.h"
#include "lib/api/validate.h"
#include "lib/engine/light_field.h"
#include "lib/io/rows.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Arguments of an API call that refocuses. `prepared` may be null.
struct Request {
  const starfocus_params& params;
  const starfocus_light_field& light_field;
  const Prepared* prepared;
  const starfocus_image& out;
};

// Fields of params.previous that checks of light fields and pictures may reject.
constexpr const char* kPreviousFields[] = {
    "previous.light_field.views[].format",
    "previous.light_field.views[].matrix",
    "previous.light_field.views[].range",
    "previous.light_field.views[].pixel_stride",
    "previous.light_field.views[].planes",
    "previous.light_field.views[].strides",
    "previous.light_field.coverage_stride",
    "previous.light_field.depth",
    "previous.light_field.depth.data",
    "previous.light_field.depth.type",
    "previous.light_field.depth.meaning",
    "previous.light_field.depth.has_invalid",
    "previous.light_field.depth.scale",
    "previous.light_field.depth.offset",
    "previous.light_field.depth.width",
    "previous.light_field.depth.height",
    "previous.light_field.depth.stride",
    "previous.out.format",
    "previous.out.matrix",
    "previous.out.range",
    "previous.out.pixel_stride",
    "previous.out.planes",
    "previous.out.strides",
};

bool AreEqual(const char* a, const char* b) {
  for (; *a != 0 && *a == *b; ++a) ++b;
  return *a == *b;
}

// Returns true if `name` is `field` of a structure, such as "previous.out.format" of "out.format".
bool EndsIn(const char* name, const char* field) {
  for (; *name != 0; ++name) {
    if (*name == '.' && AreEqual(name + 1, field)) return true;
  }
  return false;
}

// Names the rejected field of a check of the previous frame as a field of params.previous. Returns
// `status`.
starfocus_status OfPrevious(starfocus_status status, starfocus_problem* problem) {
  if (status == STARFOCUS_OK || problem == nullptr) return status;
  for (const char* name : kPreviousFields) {
    if (!EndsIn(name, problem->field)) continue;
    problem->field = name;
    break;
  }
  return status;
}

starfocus_status CheckFieldInPlace(const starfocus_config& config,
                                   const starfocus_light_field& field) {
  const starfocus_status status = CheckInPlace(field, config.views, config.problem);
  if (status != STARFOCUS_OK) return status;
  return CheckInPlace(field.depth, {config.width, config.height}, config.problem);
}

// Checks the previous frame unless params.previous is null. Frames can be compared only if both
// frames are read in place.
starfocus_status CheckPrevious(const starfocus_config& config, const Request& request,
                               const PictureSize& size) {
  const starfocus_previous* const previous = request.params.previous;
  if (previous == nullptr) return STARFOCUS_OK;
  starfocus_status status = CheckFieldInPlace(config, request.light_field);
  if (status != STARFOCUS_OK) return status;
  status = CheckLightField(config, previous->light_field);
  if (status == STARFOCUS_OK) status = CheckFieldInPlace(config, previous->light_field);
  if (status == STARFOCUS_OK) status = CheckOutput(config, previous->out, size);
  if (status != STARFOCUS_OK) return OfPrevious(status, config.problem);
  Checker check(config.problem);
  const auto need = [&](const starfocus_image& image, const char* name) {
    check.Need(IsInPlace(image), STARFOCUS_ERROR_FEATURE, {name, double(image.format)},
               {"STARFOCUS_FORMAT_RGB without gaps, for out and previous.out"});
  };
  need(request.out, "out.format");
  need(previous->out, "previous.out.format");
  return check.status();
}

// Returns the memory that `out` must not overlap: the inputs and the engine.
Extents ReadBy(const Request& request, const PictureSize& size, const EngineState& engine) {
  Extents read = MemoryOf(engine, request.prepared);
  AddLightField(engine.config, request.light_field, &read);
  if (const starfocus_previous* const previous = request.params.previous) {
    AddLightField(engine.config, previous->light_field, &read);
    AddImage(previous->out, size, &read);
  }
  return read;
}

// Returns the previous frame if it can be compared with the current frame, otherwise null. Two
// frames can be compared if both light fields have coverage, or if both lack coverage.
const starfocus_previous* ComparableOf(const Request& request) {
  const starfocus_previous* const previous = request.params.previous;
  if (previous == nullptr) return nullptr;
  const bool same =
      (previous->light_field.coverage == nullptr) == (request.light_field.coverage == nullptr);
  return same ? previous : nullptr;
}

starfocus_status CheckRequest(const Request& request, const EngineState& engine) {
  const starfocus_config& config = engine.config;
  starfocus_status status = CheckCall(config, request.params, request.prepared);
  if (status == STARFOCUS_OK) status = CheckLightField(config, request.light_field);
  if (status != STARFOCUS_OK) return status;
  const Rect rect = RegionOf(config, request.params);
  const PictureSize size = {rect.width, rect.height};
  status = CheckOutput(config, request.out, size);
  if (status == STARFOCUS_OK) status = CheckPrevious(config, request, size);
  if (status != STARFOCUS_OK) return status;
  return CheckOutputApart(request.out, size, ReadBy(request, size, engine), config.problem);
}

starfocus_status Refocus(const Request& request, EngineState* engine, starfocus_report* report) {
  const starfocus_status status = CheckRequest(request, *engine);
  if (status != STARFOCUS_OK) return status;
  LightField field;
  MakeLightField(request.light_field, 0, engine, &field);
  UseLightField(field, engine);
  Output out =
      OutputOf(request.out, RegionOf(engine->config, request.params), engine->images.odd_row);
  out.alpha = AlphaOf(field.views[0]);
  out.alpha_step = field.views[0].step;
  Call call = {request.params,   SourceOf(field),       out,
               request.prepared, ComparableOf(request), &request.light_field};
  if (request.prepared != nullptr) call.source.map = nullptr;
  return TellPlace(RunCall(call, engine, report), request.light_field.depth, 0,
                   engine->config.problem);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_refocus(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_light_field* light_field,
                                   const starfocus_image* out, starfocus_report* report) {
  starfocus_params full;
  const starfocus_status status = EnterCall(
      engine, {{"params", params}, {"light_field", light_field}, {"out", out}}, params, &full);
  if (status != STARFOCUS_OK) return status;
  auto& e = *reinterpret_cast<EngineState*>(engine);
  if (full.preview_shift != 0) {
    return Refuse(STARFOCUS_ERROR_RANGE, {"preview_shift", double(full.preview_shift)},
                  {"0 unless the light field is prepared", 0, 0}, &e.problem);
  }
  return Refocus({full, *light_field, nullptr, *out}, &e, report);
}

starfocus_status starfocus_refocus_prepared(starfocus_engine* engine,
                                            const starfocus_params* params,
                                            const starfocus_prepared* prepared,
                                            const starfocus_image* out, starfocus_report* report) {
  starfocus_params full;
  const starfocus_status status =
      EnterCall(engine, {{"params", params}, {"prepared", prepared}, {"out", out}}, params, &full);
  if (status != STARFOCUS_OK) return status;
  auto& e = *reinterpret_cast<EngineState*>(engine);
  const auto& p = *reinterpret_cast<const Prepared*>(prepared);
  if (full.preview_shift != 0) {
    return RefocusPreview({full, p, full.preview_shift}, *out, &e, report);
  }
  return Refocus({full, p.light_field, &p, *out}, &e, report);
}
