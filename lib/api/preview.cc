// SPDX-License-Identifier: Apache-2.0
#include "lib/api/preview.h"

#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/engine/engine.h"

namespace starfocus {
namespace {

starfocus_params ReducedParams(const PreviewRequest& request, const Rect& rect) {
  starfocus_params params = request.params;
  const double scale = 1.0 / (1 << request.shift);
  params.lens.focus *= scale;
  params.lens.focus_nearer *= scale;
  params.lens.focus_farther *= scale;
  if (!IsWhole(params.region)) params.region = {rect.x, rect.y, rect.width, rect.height};
  return params;
}

starfocus_status CheckPreview(const PreviewRequest& request, const EngineState& engine) {
  const starfocus_config& config = engine.config;
  Checker check(config.problem);
  CheckCall(config, request.params, &request.prepared, &check);
  if (!check.passed()) return check.status();
  const int32_t most = request.prepared.config.previews;
  check.Need(request.shift >= 1 && request.shift <= most, STARFOCUS_ERROR_PREPARED,
             {"preview_shift", double(request.shift)}, {"1 to previews", 1, double(most)});
  if (check.status() != STARFOCUS_OK) return check.status();
  return CheckBlur(config, request.params);
}

}  // namespace

starfocus_status RefocusPreview(const PreviewRequest& request, const starfocus_image& out,
                                EngineState* engine, starfocus_report* report) {
  const starfocus_status status = CheckPreview(request, *engine);
  if (status != STARFOCUS_OK) return status;
  const Rect rect = ReducedRect(RegionOf(engine->config, request.params), request.shift);
  Checker check(engine->config.problem);
  CheckOutput(engine->config, out, rect.width, rect.height, &check);
  CheckOutputApart(out, rect.width, rect.height, MemoryOf(*engine, &request.prepared), &check);
  if (!check.passed()) return check.status();
  EngineState reduced = PreviewEngine(ReducedConfig(engine->config, request.shift), engine);
  const ReducedField& field = request.prepared.reduced[request.shift];
  reduced.input = InputOf(reduced.config, *reduced.kernels, field.views, field.disparity,
                          request.prepared.covers ? field.coverage : Plane<uint8_t>());
  const starfocus_params params = ReducedParams(request, rect);
  return RunCall({params, OutputOf(out, rect, reduced.odd_row)}, &reduced, report);
}

}  // namespace starfocus
