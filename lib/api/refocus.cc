// SPDX-License-Identifier: Apache-2.0
// C API: refocuses whole pictures, regions and previews.
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/prepared.h"
#include "lib/engine/stripe.h"
#include "lib/io/output.h"

namespace starfocus {
namespace {

// Checks `params` and the prepared light field, which may be null, against the configuration of
// the engine.
void CheckCall(const FullConfig& config, const FullParams& params, const Prepared* prepared,
               Checker* check) {
  CheckParams(config, params, check);
  CheckRegion(params.region, config.width, config.height, check);
  if (prepared == nullptr) return;
  check->Need(Fits(*prepared, config), STARFOCUS_ERROR_PREPARED, {"prepared"},
              {"prepared with the engine's size, views, positions, disparity range, max_layer and "
               "transfer"});
  check->Need(params.previous == nullptr, STARFOCUS_ERROR_RANGE, {"previous"},
              {"null if the light field is prepared"});
}

// Returns the address ranges of the engine and of a prepared light field. Outputs must not overlap
// these address ranges.
Extents MemoryOf(const EngineState& engine, const Prepared* prepared) {
  Extents memory;
  memory.Add(Workspace(engine));
  if (prepared != nullptr) memory.Add(PreparedMemory(*prepared));
  return memory;
}

// Runs a refocusing. Before this call, the caller must set the engine's input and check
// all arguments except the values of the map. `previous` and `now` are the previous frame and the
// current light field of a video; previous.light_field is null if frames are not compared.
starfocus_status RunCall(const FullParams& params, const Output& out,
                         const starfocus_previous& previous, const starfocus_light_field* now,
                         EngineState* engine, starfocus_report* report) {
  engine->stream.active = false;
  engine->jobs->call_progress.Begin(0, RegionOf(engine->config, params).height);
  Checker check(engine->config.problem);
  if (check.Add(SetLens(params, engine)) != STARFOCUS_OK) return check.status();
  if (previous.light_field != nullptr) StartFrameDiff(previous, now, engine);
  check.Add(RefocusRows(out, engine));
  if (check.passed()) WriteReport(*engine, report);
  return check.status();
}

// Returns the parameters in pixels of the preview, whose region is `rect`.
FullParams ReducedParams(const FullParams& full, const Rect& rect) {
  FullParams params = full;
  const double scale = 1.0 / (1 << full.preview_shift);
  params.focus *= scale;
  params.focus_nearer *= scale;
  params.focus_farther *= scale;
  if (!IsWhole(params.region)) params.region = {rect.x, rect.y, rect.width, rect.height};
  return params;
}

// Checks the arguments, refocuses the light field that is reduced by params.preview_shift, and
// writes the picture to `out`. The lens and region of `params` are in pixels of the full size.
starfocus_status RefocusPreview(const FullParams& params, const Prepared& prepared,
                                const starfocus_image& out, EngineState* engine,
                                starfocus_report* report) {
  const FullConfig& config = engine->config;
  const int32_t shift = params.preview_shift, most = prepared.config.previews;
  Checker check(config.problem);
  CheckCall(config, params, &prepared, &check);
  check.Need(shift >= 1 && shift <= most, STARFOCUS_ERROR_PREPARED,
             {"preview_shift", double(shift)},
             {"0 to previews of the engine that prepared", 0, double(most)});
  if (!check.passed()) return check.status();
  const Rect rect = ReducedRect(RegionOf(config, params), shift);
  CheckOutput(config, out, rect.width, rect.height, &check);
  CheckOutputApart(out, rect.width, rect.height, MemoryOf(*engine, &prepared), &check);
  if (!check.passed()) return check.status();
  EngineState reduced = PreviewEngine(ReducedConfig(config, shift), engine);
  const ReducedField& field = prepared.reduced[shift];
  StoredViews views = field.views;
  views.tables = reduced.deep;
  reduced.input = InputOf(reduced.config, *reduced.kernels, views, field.disparity,
                          prepared.covers ? field.coverage : Plane<uint8_t>());
  reduced.input.has_alpha = prepared.has_alpha;
  return RunCall(ReducedParams(params, rect), OutputOf(reduced, out, rect), {}, nullptr, &reduced,
                 report);
}

// Fields of params.previous that checks of light fields and pictures may reject.
constexpr const char* kPreviousFields[] = {
    STARFOCUS_IMAGE_FIELDS("previous.light_field.views[]."),
    STARFOCUS_IMAGE_FIELDS("previous.out."),
    "previous.light_field.size",
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

// Checks the previous frame, and copies it and its light field to *previous and *field. Frames can
// be compared only if both frames are read in place.
void CheckPrevious(const EngineState& engine, const FullParams& params, const starfocus_image& out,
                   starfocus_previous* previous, starfocus_light_field* field, Checker* check) {
  const FullConfig& config = engine.config;
  const Rect rect = RegionOf(config, params);
  if (!check->passed()) return;
  check->Read(*params.previous, "previous.size", previous);
  check->NotNull(previous->light_field, "previous.light_field");
  check->NotNull(previous->out, "previous.out");
  if (!check->passed()) return;
  check->Read(*previous->light_field, "light_field.size", field);
  CheckLightField(config, *field, check);
  CheckInPlace(config, *field, true, check);
  CheckOutput(config, *previous->out, rect.width, rect.height, check);
  if (!check->passed()) {
    NamePrevious(config.problem);
    return;
  }
  const auto need = [&](const starfocus_image& image, const char* name) {
    check->Need(IsInPlace(image), STARFOCUS_ERROR_FEATURE, {name, double(image.format)},
                {"STARFOCUS_FORMAT_RGB without gaps, for out and previous.out"});
  };
  need(out, "out.format");
  need(*previous->out, "previous.out.format");
}

// Checks the arguments of an API call that refocuses, and makes the engine read the light field,
// whose disparities and layers may be prepared. Sets *previous to the frame to compare, if there is
// one. `prepared` may be null. Not inlined, so that light fields, address ranges and inputs, which
// are large, are not on the stack while the picture is refocused.
[[gnu::noinline]] void TakeArguments(const FullParams& params, const starfocus_light_field& given,
                                     const Prepared* prepared, const starfocus_image& out,
                                     EngineState* engine, starfocus_previous* previous,
                                     Checker* check) {
  const FullConfig& config = engine->config;
  starfocus_light_field field = {}, before = {};
  CheckCall(config, params, prepared, check);
  check->Read(given, "light_field.size", &field);
  CheckLightField(config, field, check);
  if (!check->passed()) return;
  const Rect rect = RegionOf(config, params);
  CheckOutput(config, out, rect.width, rect.height, check);
  if (params.previous != nullptr) {
    check->Need(!HasDeep(config), STARFOCUS_ERROR_FEATURE, {"previous"},
                {"null with STARFOCUS_FEATURE_DEEP"});
    CheckInPlace(config, field, true, check);
    CheckPrevious(*engine, params, out, previous, &before, check);
  }
  if (!check->passed()) return;
  Extents read = MemoryOf(*engine, prepared);
  AddLightField(config, field, &read);
  if (params.previous != nullptr) {
    AddLightField(config, before, &read);
    AddImage(*previous->out, rect.width, rect.height, &read);
  }
  CheckOutputApart(out, rect.width, rect.height, read, check);
  if (!check->passed()) return;
  // Two frames can be compared if both light fields have coverage, or if both lack coverage.
  if ((before.coverage == nullptr) != (field.coverage == nullptr)) *previous = {};
  engine->input = InputOf(config, *engine->kernels, field, 0, &engine->rings);
  if (prepared != nullptr) UsePrepared(*prepared, &engine->input);
}

starfocus_status Refocus(const FullParams& params, const starfocus_light_field& light_field,
                         const Prepared* prepared, const starfocus_image& to, EngineState* engine,
                         starfocus_report* report) {
  Checker check(engine->config.problem);
  starfocus_previous previous = {};
  TakeArguments(params, light_field, prepared, to, engine, &previous, &check);
  if (!check.passed()) return check.status();
  const Input& in = engine->input;
  Output out = OutputOf(*engine, to, RegionOf(engine->config, params));
  out.alpha = AlphaOf(in.images[0]);
  out.alpha_step = in.images[0].step;
  const starfocus_status status = RunCall(params, out, previous, &light_field, engine, report);
  return TellPlace(status, in.map.map, 0, engine->config.problem);
}

}  // namespace
}  // namespace starfocus

using namespace starfocus;

starfocus_status starfocus_refocus(starfocus_engine* engine, const starfocus_params* params,
                                   const starfocus_light_field* light_field,
                                   const starfocus_image* out, starfocus_report* report) {
  FullParams full;
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  check.NotNull(light_field, "light_field");
  check.NotNull(out, "out");
  CheckReport(report, &check);
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
  FullParams full;
  Checker check = Enter(engine);
  check.NotNull(params, "params");
  check.NotNull(prepared, "prepared");
  check.NotNull(out, "out");
  CheckReport(report, &check);
  ReadParams(params, &full, &check);
  if (!check.passed()) return check.status();
  auto& e = *reinterpret_cast<EngineState*>(engine);
  const auto& p = *reinterpret_cast<const Prepared*>(prepared);
  if (full.preview_shift != 0) return RefocusPreview(full, p, *out, &e, report);
  return Refocus(full, p.light_field, &p, *out, &e, report);
}
