// SPDX-License-Identifier: Apache-2.0
#include "lib/api/preview.h"

#include "lib/api/call.h"
#include "lib/api/validate.h"
#include "lib/engine/layout.h"
#include "lib/source/light_field.h"

namespace starfocus {
namespace {

// As long as it lives, the engine is one of the size of previews.
class Reduction {
 public:
  Reduction(int32_t shift, EngineState* engine) : config_(engine->config), engine_(engine) {
    LayOutAnew(ReducedConfig(config_, shift), engine);
  }
  ~Reduction() { LayOutAnew(config_, engine_); }
  Reduction(const Reduction&) = delete;
  Reduction& operator=(const Reduction&) = delete;

 private:
  const sf_config config_;
  EngineState* const engine_;
};

sf_params ReducedParams(const PreviewRequest& request, const Rect& rect) {
  sf_params params = request.params;
  params.lens.focus /= 1 << request.shift;
  if (!IsWhole(params.region)) params.region = {rect.x, rect.y, rect.width, rect.height};
  return params;
}

void UseReduced(const Prepared& prepared, int32_t shift, EngineState* engine) {
  const ReducedField& field = prepared.reduced[shift];
  SetPlanes(engine->config, *engine->kernels, field.views, &engine->pictures);
  for (Window& window : engine->pictures.windows) {
    window.disparity = {field.disparity.data, field.disparity.stride, 0, 0};
  }
  if (!prepared.covers) return;
  engine->pictures.windows[0].given_coverage = {field.coverage.data, field.coverage.stride, 0, 0};
}

sf_status CheckPicture(const Picture& picture, const PreviewRequest& request,
                       const EngineState& engine) {
  const Rect& rect = picture.rect;
  const sf_status status = CheckOutput(engine.config, rect, picture.data, picture.stride);
  if (status != SF_OK) return status;
  const Extent out =
      ExtentOf(picture.data, picture.stride, rect.height, 3 * static_cast<size_t>(rect.width));
  return CheckApart(out, MemoryOf(engine, &request.prepared), "out", engine.config.problem);
}

}  // namespace

sf_status CheckPreview(const PreviewRequest& request, const EngineState& engine) {
  const sf_config& config = engine.config;
  const sf_status status = CheckCall(config, request.params, &request.prepared);
  if (status != SF_OK) return status;
  const int32_t most = request.prepared.config.previews;
  Checker check(config.problem);
  check.Need(request.shift >= 1 && request.shift <= most, SF_ERROR_PREPARED,
             {"shift", double(request.shift)}, {"1 to previews", 1, double(most)});
  if (check.status() != SF_OK) return check.status();
  return CheckBlur(config, LargestBlur(config, request.params));
}

Rect PreviewRect(const PreviewRequest& request, const EngineState& engine) {
  return ReducedRect(RegionOf(engine.config, request.params), request.shift);
}

sf_status RefocusPreview(const PreviewRequest& request, const RowSink& sink, EngineState* engine,
                         sf_report* report) {
  const sf_params params = ReducedParams(request, PreviewRect(request, *engine));
  const Reduction reduction(request.shift, engine);
  UseReduced(request.prepared, request.shift, engine);
  return RunCall({params, {}, sink}, engine, report);
}

}  // namespace starfocus

sf_status sf_refocus_preview(sf_engine* engine, const sf_params* params,
                             const sf_prepared* prepared, int32_t shift, uint8_t* out,
                             size_t out_stride, sf_report* report) {
  sf_params full;
  sf_status status =
      starfocus::EnterCall(engine, {{"params", params}, {"prepared", prepared}}, params, &full);
  if (status != SF_OK) return status;
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  const starfocus::PreviewRequest request = {
      full, *reinterpret_cast<const starfocus::Prepared*>(prepared), shift};
  status = starfocus::CheckPreview(request, e);
  if (status != SF_OK) return status;
  const starfocus::Picture picture = {out, out_stride, starfocus::PreviewRect(request, e)};
  status = starfocus::CheckPicture(picture, request, e);
  if (status != SF_OK) return status;
  return starfocus::RefocusPreview(request, starfocus::SinkOf(picture), &e, report);
}
