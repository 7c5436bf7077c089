// SPDX-License-Identifier: Apache-2.0
#include "lib/api/preview.h"

#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/engine/layout.h"

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

void UseReduced(const Prepared& prepared, int32_t shift, EngineState* engine) {
  const ReducedField& field = prepared.reduced[shift];
  SetPlanes(engine->config, *engine->kernels, field.views, &engine->row_store);
  for (Window& window : engine->row_store.windows) {
    window.disparity = {field.disparity.data, field.disparity.stride, 0, 0};
  }
  if (!prepared.covers) return;
  engine->row_store.windows[0].given_coverage = {field.coverage.data, field.coverage.stride, 0, 0};
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
  UseReduced(request.prepared, request.shift, &reduced);
  const starfocus_params params = ReducedParams(request, rect);
  return RunCall({params, {}, OutputOf(out, rect, reduced.images.odd_row)}, &reduced, report);
}

}  // namespace starfocus
