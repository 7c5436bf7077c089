// SPDX-License-Identifier: Apache-2.0
// C API: refocuses whole pictures, regions and previews.

#include "lib/api/call.h"
#include "lib/api/preview.h"
#include "lib/api/validate.h"
#include "lib/io/image.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

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

// Returns true if `name` is `field` of a structure, such as "previous.out.format" of "out.format".
bool EndsIn(const char* name, const char* field) {
  for (; *name != 0; ++name) {
    if (*name == '.' && AreEqual(name + 1, field)) return true;
  }
  return false;
}

// Names the rejected field of a check of the previous frame as a field of params.previous.
void NamePrevious(starfocus_problem* problem) {
  for (const char* name : kPreviousFields) {
    if (!EndsIn(name, problem->field)) continue;
    problem->field = name;
    break;
  }
}

void CheckFieldInPlace(const starfocus_config& config, const starfocus_light_field& field,
                       Checker* check) {
  CheckInPlace(field, config.views, check);
  CheckInPlace(field.depth, config.width, config.height, check);
}

// Checks the previous frame. Frames can be compared only if both frames are read in place.
void CheckPrevious(const starfocus_config& config, const starfocus_previous& previous,
                   const starfocus_light_field& light_field, const starfocus_image& out,
                   const Rect& rect, Checker* check) {
  CheckFieldInPlace(config, light_field, check);
  if (!check->passed()) return;
  CheckLightField(config, previous.light_field, check);
  CheckFieldInPlace(config, previous.light_field, check);
  CheckOutput(config, previous.out, rect.width, rect.height, check);
  if (!check->passed()) {
    NamePrevious(config.problem);
    return;
  }
  const auto need = [&](const starfocus_image& image, const char* name) {
    check->Need(IsInPlace(image), STARFOCUS_ERROR_FEATURE, {name, double(image.format)},
                {"STARFOCUS_FORMAT_RGB without gaps, for out and previous.out"});
  };
  need(out, "out.format");
  need(previous.out, "previous.out.format");
}

// Checks the arguments of an API call that refocuses. `prepared` may be null.
void CheckRefocus(const starfocus_params& params, const starfocus_light_field& light_field,
                  const Prepared* prepared, const starfocus_image& out, const EngineState& engine,
                  Checker* check) {
  const starfocus_config& config = engine.config;
  const starfocus_previous* const previous = params.previous;
  CheckCall(config, params, prepared, check);
  CheckLightField(config, light_field, check);
  if (!check->passed()) return;
  const Rect rect = RegionOf(config, params);
  CheckOutput(config, out, rect.width, rect.height, check);
  if (previous != nullptr) CheckPrevious(config, *previous, light_field, out, rect, check);
  if (!check->passed()) return;
  Extents read = MemoryOf(engine, prepared);
  AddLightField(config, light_field, &read);
  if (previous != nullptr) {
    AddLightField(config, previous->light_field, &read);
    AddImage(previous->out, rect.width, rect.height, &read);
  }
  CheckOutputApart(out, rect.width, rect.height, read, check);
}

starfocus_status Refocus(const starfocus_params& params, const starfocus_light_field& light_field,
                         const Prepared* prepared, const starfocus_image& to, EngineState* engine,
                         starfocus_report* report) {
  const starfocus_config& config = engine->config;
  Checker check(config.problem);
  CheckRefocus(params, light_field, prepared, to, *engine, &check);
  if (!check.passed()) return check.status();
  Input in = InputOf(config, *engine->kernels, light_field, 0, &engine->rings);
  engine->input = prepared == nullptr ? in : InputOf(*prepared, in);
  Output out = OutputOf(to, RegionOf(config, params), engine->odd_row);
  out.alpha = AlphaOf(in.images[0]);
  out.alpha_step = in.images[0].step;
  // Two frames can be compared if both light fields have coverage, or if both lack coverage.
  const starfocus_previous* const previous = params.previous;
  const bool comparable = previous != nullptr && (previous->light_field.coverage == nullptr) ==
                                                     (light_field.coverage == nullptr);
  const starfocus_status status =
      RunCall(params, out, comparable ? previous : nullptr, &light_field, engine, report);
  return TellPlace(status, light_field.depth, 0, config.problem);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_refocus(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_light_field* light_field,
                                   const starfocus_image* out, starfocus_report* report) {
  starfocus_params full;
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  check.NotNull(light_field, "light_field");
  check.NotNull(out, "out");
  ReadParams(params, &full, &check);
  if (!check.passed()) return check.status();
  check.In({"preview_shift", double(full.preview_shift)},
           {"0 unless the light field is prepared", 0, 0});
  if (!check.passed()) return check.status();
  auto& e = *reinterpret_cast<EngineState*>(engine);
  return Refocus(full, *light_field, nullptr, *out, &e, report);
}

starfocus_status starfocus_refocus_prepared(starfocus_engine* engine,
                                            const starfocus_params* params,
                                            const starfocus_prepared* prepared,
                                            const starfocus_image* out, starfocus_report* report) {
  starfocus_params full;
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  check.NotNull(prepared, "prepared");
  check.NotNull(out, "out");
  ReadParams(params, &full, &check);
  if (!check.passed()) return check.status();
  auto& e = *reinterpret_cast<EngineState*>(engine);
  const auto& p = *reinterpret_cast<const Prepared*>(prepared);
  if (full.preview_shift != 0) return RefocusPreview(full, p, *out, &e, report);
  return Refocus(full, p.light_field, &p, *out, &e, report);
}
