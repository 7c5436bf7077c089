// SPDX-License-Identifier: Apache-2.0
#include "lib/api/preview.h"

#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/engine/engine.h"

namespace starfocus {
namespace {

// Returns the parameters in pixels of the preview, whose region is `rect`.
starfocus_params ReducedParams(const starfocus_params& full, const Rect& rect) {
  starfocus_params params = full;
  const double scale = 1.0 / (1 << full.preview_shift);
  params.lens.focus *= scale;
  params.lens.focus_nearer *= scale;
  params.lens.focus_farther *= scale;
  if (!IsWhole(params.region)) params.region = {rect.x, rect.y, rect.width, rect.height};
  return params;
}

}  // namespace

starfocus_status RefocusPreview(const starfocus_params& params, const Prepared& prepared,
                                const starfocus_image& out, EngineState* engine,
                                starfocus_report* report) {
  const starfocus_config& config = engine->config;
  const int32_t shift = params.preview_shift, most = prepared.config.previews;
  Checker check(config.problem);
  CheckCall(config, params, &prepared, &check);
  check.Need(shift >= 1 && shift <= most, STARFOCUS_ERROR_PREPARED,
             {"preview_shift", double(shift)}, {"1 to previews", 1, double(most)});
  if (!check.passed()) return check.status();
  check.Add(CheckBlur(config, params));
  const Rect rect = ReducedRect(RegionOf(config, params), shift);
  CheckOutput(config, out, rect.width, rect.height, &check);
  CheckOutputApart(out, rect.width, rect.height, MemoryOf(*engine, &prepared), &check);
  if (!check.passed()) return check.status();
  EngineState reduced = PreviewEngine(ReducedConfig(config, shift), engine);
  const ReducedField& field = prepared.reduced[shift];
  reduced.input = InputOf(reduced.config, *reduced.kernels, field.views, field.disparity,
                          prepared.covers ? field.coverage : Plane<uint8_t>());
  return RunCall(ReducedParams(params, rect), OutputOf(out, rect, reduced.odd_row), nullptr,
                 nullptr, &reduced, report);
}

}  // namespace starfocus
