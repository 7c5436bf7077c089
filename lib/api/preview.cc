// SPDX-License-Identifier: Apache-2.0
#include "lib/api/preview.h"

#include <cstring>

#include "lib/api/stripe_rows.h"
#include "lib/api/validate.h"
#include "lib/engine/layout.h"
#include "lib/engine/stripe.h"

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
  params.focus /= 1 << request.shift;
  if (!IsWhole(params.region)) params.region = {rect.x, rect.y, rect.width, rect.height};
  return params;
}

void UseReduced(const ReducedField& field, EngineState* engine) {
  Plane<const uint8_t> views[kMaxViews];
  for (int view = 0; view < engine->config.views; ++view) {
    views[view] = {field.views[view].data, field.views[view].stride, 0, 0};
  }
  SetPlanes(engine->config, *engine->kernels, views, &engine->pictures);
  for (Window& window : engine->pictures.windows) {
    window.disparity = {field.disparity.data, field.disparity.stride, 0, 0};
  }
}

sf_status RefocusStripes(const Rect& rect, const RowSink& sink, const Runner& runner,
                         EngineState* engine) {
  const int32_t side = engine->config.largest_block, rect_end = rect.y + rect.height;
  const RowRange stripes = StripeRows(*engine);
  Watch& watch = engine->crew.jobs.watch;
  for (int32_t y = stripes.first; y < stripes.last; y += side) {
    sf_status status = RefocusIntoBuffer(engine, y, runner);
    if (status != SF_OK) return status;
    const bool is_last = y + side >= stripes.last;
    const int32_t end = is_last ? rect_end : Min(FinishedRows(engine->config, y), rect_end);
    status = sink.write(sink.out, BufferRows(*engine, y), {Max(y - kDeblockRows, rect.y), end},
                        runner, engine);
    if (status != SF_OK) return status;
    watch.SetRows(Max(0, end - rect.y));
  }
  return watch.Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

// A picture of the caller's for `rect` of the preview.
struct Picture {
  uint8_t* data;
  size_t stride;
  Rect rect;
};

sf_status WriteRows(const void* out, const Plane<uint8_t>& from, const RowRange& rows,
                    const Runner&, EngineState*) {
  const auto& picture = *static_cast<const Picture*>(out);
  const Rect& rect = picture.rect;
  for (int32_t y = rows.first; y < rows.last; ++y) {
    std::memcpy(picture.data + static_cast<size_t>(y - rect.y) * picture.stride,
                from.Row(y) + 3 * static_cast<size_t>(rect.x), 3 * static_cast<size_t>(rect.width));
  }
  return SF_OK;
}

sf_status CheckPicture(const Picture& picture, const PreviewRequest& request,
                       const EngineState& engine) {
  const Rect& rect = picture.rect;
  const sf_status status = CheckOutput(rect.width, rect.height, picture.data, picture.stride);
  if (status != SF_OK) return status;
  const Extent out =
      ExtentOf(picture.data, picture.stride, rect.height, 3 * static_cast<size_t>(rect.width));
  const bool overlaps =
      Overlaps(out, Workspace(engine)) || Overlaps(out, PreparedMemory(request.prepared));
  return overlaps ? SF_ERROR_OVERLAP : SF_OK;
}

}  // namespace

sf_status CheckPreview(const PreviewRequest& request, const EngineState& engine) {
  const sf_config& config = engine.config;
  sf_status status = CheckParams(config, request.params);
  if (status == SF_OK) status = CheckRegion(config, request.params.region);
  if (status != SF_OK) return status;
  if (!Fits(request.prepared, config)) return SF_ERROR_PREPARED;
  if (request.shift < 1 || request.shift > request.prepared.config.previews) {
    return SF_ERROR_PREVIEW;
  }
  return LargestBlur(config, request.params) > config.max_blur ? SF_ERROR_BLUR_TOO_LARGE : SF_OK;
}

Rect PreviewRect(const PreviewRequest& request, const EngineState& engine) {
  return ReducedRect(RegionOf(engine.config, request.params), request.shift);
}

sf_status RefocusPreview(const PreviewRequest& request, const RowSink& sink, const Runner& runner,
                         EngineState* engine, sf_report* report) {
  const Rect rect = PreviewRect(request, *engine);
  const sf_params params = ReducedParams(request, rect);
  engine->stream.active = false;
  const Reduction reduction(request.shift, engine);
  engine->crew.jobs.watch.Begin(params.progress, params.progress_data, 0, rect.height);
  sf_status status = SetLens(params, engine);
  if (status != SF_OK) return status;
  UseReduced(request.prepared.reduced[request.shift], engine);
  status = RefocusStripes(rect, sink, runner, engine);
  if (status == SF_OK && report != nullptr) *report = engine->report;
  return status;
}

}  // namespace starfocus

sf_status sf_refocus_preview(sf_engine* engine, const sf_params* params,
                             const sf_prepared* prepared, int32_t shift, uint8_t* out,
                             size_t out_stride, sf_runner runner, void* runner_data,
                             sf_report* report) {
  if (engine == nullptr || params == nullptr || prepared == nullptr) return SF_ERROR_NULL;
  auto& e = *reinterpret_cast<starfocus::EngineState*>(engine);
  const starfocus::PreviewRequest request = {
      *params, *reinterpret_cast<const starfocus::Prepared*>(prepared), shift};
  sf_status status = starfocus::CheckPreview(request, e);
  if (status != SF_OK) return status;
  const starfocus::Picture picture = {out, out_stride, starfocus::PreviewRect(request, e)};
  status = starfocus::CheckPicture(picture, request, e);
  if (status != SF_OK) return status;
  return starfocus::RefocusPreview(request, {starfocus::WriteRows, &picture}, {runner, runner_data},
                                   &e, report);
}
