// The C ABI for whole pictures and regions of them: checks, then stripe by stripe.
#include <cstring>

#include "lib/engine.h"
#include "lib/layout.h"
#include "lib/light_field.h"
#include "lib/prepared.h"
#include "lib/stripe.h"
#include "lib/validate.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Where a picture goes: rows of the region.
struct Output {
  uint8_t* data;
  size_t stride;
  Rect region;

  size_t RowBytes() const { return 3 * static_cast<size_t>(region.width); }
};

// Rows of the stripes that the region needs; a stripe's first row is a multiple of the largest
// block.
RowRange StripeRows(const EngineState& engine) {
  const Rect& region = engine.region;
  const int32_t reach = IsDeblocking(engine) ? kDeblockReach : 0;
  const int32_t side = engine.config.largest_block;
  return {Max(0, region.y - reach) / side * side,
          Min(engine.config.height, region.y + region.height + reach)};
}

// Everything that the stripes may read is checked before the first pixel is written.
sf_status CheckDisparity(const EngineState& engine, const sf_light_field& light_field) {
  const RowRange stripes = StripeRows(engine);
  const int32_t side = engine.config.largest_block;
  const int32_t end = (stripes.last + side - 1) / side * side + engine.reach.rows;
  for (int32_t y = Max(0, stripes.first - engine.reach.rows); y < Min(engine.config.height, end);
       ++y) {
    const sf_status status =
        ConvertDisparity(engine, DisparityRow(light_field, y), engine.disparity.Row(0));
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

// Writes rows of the region, up to row `end`, that the stripe at row y finished in the engine's own
// rows.
void WriteRows(const EngineState& engine, int32_t y, int32_t end, const Output& out) {
  const Plane<uint8_t> rows = BufferRows(engine, y);
  const Rect& region = out.region;
  for (int32_t row = Max(y - kDeblockRows, region.y); row < end; ++row) {
    std::memcpy(out.data + static_cast<size_t>(row - region.y) * out.stride,
                rows.Row(row) + 3 * static_cast<size_t>(region.x), out.RowBytes());
  }
}

// Converts the rows that the stripe at row y reads and no stripe before it.
sf_status PushRows(const sf_light_field& light_field, int32_t y, EngineState* engine) {
  const int32_t needed = Min(engine->config.height, y + BlockSide(*engine) + engine->reach.rows);
  while (engine->disparity_rows < needed) {
    const sf_status status =
        PushDisparity(DisparityRow(light_field, engine->disparity_rows), engine);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

sf_status RefocusStripes(EngineState* engine, const sf_light_field& light_field, const Output& out,
                         const Runner& runner) {
  const int32_t side = BlockSide(*engine);
  const RowRange stripes = StripeRows(*engine);
  const bool whole = IsWhole(engine->params.region);
  engine->disparity_rows = Max(0, stripes.first - engine->reach.rows);
  for (int32_t y = stripes.first; y < stripes.last; y += side) {
    sf_status status = engine->prepared ? SF_OK : PushRows(light_field, y, engine);
    if (status != SF_OK) return status;
    status = whole ? RefocusStripe(engine, y, {out.data, out.stride, 0, 0}, runner)
                   : RefocusIntoBuffer(engine, y, runner);
    if (status != SF_OK) return status;
    if (whole) continue;
    // The stripe after the last one changes nothing of the region.
    const int32_t end = out.region.y + out.region.height;
    const bool last = y + side >= stripes.last;
    WriteRows(*engine, y, last ? end : Min(FinishedRows(*engine, y), end), out);
  }
  return SF_OK;
}

// A refocusing as the C ABI asks for it; one of light_field and prepared.
struct Request {
  const sf_params* params;
  const sf_light_field* light_field;
  const Prepared* prepared;
  uint8_t* out;
  size_t out_stride;
  Runner runner;
};

sf_status CheckRequest(const Request& request, const EngineState& engine) {
  const sf_config& config = engine.config;
  sf_status status = CheckParams(*request.params);
  if (status == SF_OK) status = CheckRegion(config, request.params->region);
  if (status != SF_OK) return status;
  if (request.prepared != nullptr && !Fits(*request.prepared, config)) return SF_ERROR_PREPARED;
  status = CheckLightField(config, *request.light_field);
  if (status != SF_OK) return status;
  const Rect region = RegionOf(config, *request.params);
  status = CheckOutput(region.width, region.height, request.out, request.out_stride);
  if (status != SF_OK) return status;
  const Extent out = ExtentOf(request.out, request.out_stride, region.height,
                              3 * static_cast<size_t>(region.width));
  const bool overlaps =
      Overlaps(out, Workspace(engine)) || OverlapsLightField(out, config, *request.light_field) ||
      (request.prepared != nullptr && Overlaps(out, PreparedMemory(*request.prepared)));
  return overlaps ? SF_ERROR_OVERLAP : SF_OK;
}

sf_status Refocus(const Request& request, EngineState* engine, sf_report* report) {
  sf_status status = CheckRequest(request, *engine);
  if (status != SF_OK) return status;
  engine->stream.active = false;
  status = SetLens(*request.params, engine);
  if (status != SF_OK) return status;
  SetPictures(*request.light_field, engine);
  if (request.prepared != nullptr) {
    UsePrepared(*request.prepared, engine);
  } else {
    status = CheckDisparity(*engine, *request.light_field);
    if (status != SF_OK) return status;
  }
  const Output out = {request.out, request.out_stride, engine->region};
  status = RefocusStripes(engine, *request.light_field, out, request.runner);
  if (status == SF_OK && report != nullptr) *report = GetReport(*engine);
  return status;
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus(sf_engine* engine, const sf_params* params, const sf_light_field* light_field,
                     uint8_t* out, size_t out_stride, sf_runner runner, void* runner_data,
                     sf_report* report) {
  if (engine == nullptr || params == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  return starfocus::Refocus({params, light_field, nullptr, out, out_stride, {runner, runner_data}},
                            reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_prepared(sf_engine* engine, const sf_params* params,
                              const sf_prepared* prepared, uint8_t* out, size_t out_stride,
                              sf_runner runner, void* runner_data, sf_report* report) {
  if (engine == nullptr || params == nullptr || prepared == nullptr) return SF_ERROR_NULL;
  const auto* p = reinterpret_cast<const starfocus::Prepared*>(prepared);
  return starfocus::Refocus({params, &p->light_field, p, out, out_stride, {runner, runner_data}},
                            reinterpret_cast<EngineState*>(engine), report);
}
