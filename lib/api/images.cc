// SPDX-License-Identifier: Apache-2.0
// The C ABI for whole images and regions of them: checks, then stripe by stripe.
#include "lib/api/image_field.h"
#include "lib/api/image_output.h"
#include "lib/api/prepared.h"
#include "lib/api/stripe_rows.h"
#include "lib/api/validate.h"
#include "lib/api/validate_image.h"
#include "lib/engine/layout.h"
#include "lib/engine/lens.h"
#include "lib/engine/stripe.h"
#include "starfocus/image.h"

namespace starfocus {
namespace {

// A refocusing as the C ABI asks for it; prepared may be null.
struct Request {
  const sf_params& params;
  const sf_image_field& field;
  const Prepared* prepared;
  const sf_image_out& out;
};

sf_status CheckOut(const sf_image& out, const Request& request, const EngineState& engine) {
  const Rect region = RegionOf(engine.config, request.params);
  const int32_t width = region.width, height = region.height;
  const sf_status status = CheckImage(out, width, height);
  if (status != SF_OK) return status;
  bool overlaps = OverlapsImage(Workspace(engine), out, width, height) ||
                  OverlapsField(out, width, height, engine.config, request.field);
  if (request.prepared != nullptr) {
    overlaps = overlaps || OverlapsImage(PreparedMemory(*request.prepared), out, width, height);
  }
  return overlaps ? SF_ERROR_OVERLAP : SF_OK;
}

sf_status CheckRequest(const EngineState& engine, const Request& request) {
  const sf_config& config = engine.config;
  if (config.images == 0) return SF_ERROR_STATE;
  sf_status status = CheckParams(config, request.params);
  if (status == SF_OK) status = CheckRegion(config, request.params.region);
  if (status != SF_OK) return status;
  if (request.prepared != nullptr && !Fits(*request.prepared, config)) return SF_ERROR_PREPARED;
  status = CheckImageField(config, request.field);
  if (status != SF_OK) return status;
  return CheckOut(AsImage(request.out), request, engine);
}

// Rows of the picture are read once, before the stripe that is the first to need them.
sf_status RefocusStripes(const ImageField& field, const ImageOutput& out, const Runner& runner,
                         EngineState* engine) {
  const int32_t side = engine->config.largest_block, reach = engine->lens.reach.rows;
  const RowRange stripes = StripeRows(*engine);
  const int32_t region_end = out.rect.y + out.rect.height;
  RowRange read = {Max(0, stripes.first - reach), 0};
  for (int32_t y = stripes.first; y < stripes.last; y += side) {
    read.last = Min(engine->config.height, y + side + reach);
    const Plane<int16_t>* disparity =
        engine->pictures.prepared ? nullptr : &engine->pictures.disparity;
    sf_status status = ReadImageRows(field, read, disparity, runner, engine);
    read.first = read.last;
    if (status == SF_OK) status = RefocusIntoBuffer(engine, y, runner);
    if (status != SF_OK) return status;
    const bool is_last = y + side >= stripes.last;
    const int32_t end = is_last ? region_end : Min(FinishedRows(engine->config, y), region_end);
    status = WriteImageRows(out, BufferRows(*engine, y), {Max(y - kDeblockRows, out.rect.y), end},
                            runner, engine);
    if (status != SF_OK) return status;
    engine->crew.jobs.watch.SetRows(Max(0, end - out.rect.y));
  }
  return engine->crew.jobs.watch.Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

sf_status Refocus(const Request& request, const Runner& runner, EngineState* engine,
                  sf_report* report) {
  sf_status status = CheckRequest(*engine, request);
  if (status != SF_OK) return status;
  engine->stream.active = false;
  const sf_params& params = request.params;
  const Rect region = RegionOf(engine->config, params);
  engine->crew.jobs.watch.Begin(params.progress, params.progress_data, 0, region.height);
  status = SetLens(params, engine);
  if (status != SF_OK) return status;
  ImageField field;
  MakeImageField(request.field, engine, &field);
  UseImageField(field, engine);
  if (request.prepared != nullptr) {
    UsePrepared(*request.prepared, engine);
  } else {
    status = CheckDepths(MapRows(*engine), engine, &field);
    if (status != SF_OK) return status;
  }
  const ImageOutput out = {field.kernels, PlanesOf(request.out), region, AlphaOf(field.views[0])};
  status = RefocusStripes(field, out, runner, engine);
  if (status == SF_OK && report != nullptr) *report = engine->report;
  return status;
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus_images(sf_engine* engine, const sf_params* params, const sf_image_field* field,
                            const sf_image_out* out, sf_runner runner, void* runner_data,
                            sf_report* report) {
  if (engine == nullptr || params == nullptr || field == nullptr || out == nullptr) {
    return SF_ERROR_NULL;
  }
  return starfocus::Refocus({*params, *field, nullptr, *out}, {runner, runner_data},
                            reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_prepared_images(sf_engine* engine, const sf_params* params,
                                     const sf_prepared* prepared, const sf_image_out* out,
                                     sf_runner runner, void* runner_data, sf_report* report) {
  if (engine == nullptr || params == nullptr || prepared == nullptr || out == nullptr) {
    return SF_ERROR_NULL;
  }
  const auto* p = reinterpret_cast<const starfocus::Prepared*>(prepared);
  if (p->images == nullptr) return SF_ERROR_PREPARED;
  return starfocus::Refocus({*params, *p->images, p, *out}, {runner, runner_data},
                            reinterpret_cast<EngineState*>(engine), report);
}
