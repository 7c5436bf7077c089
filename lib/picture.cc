// The C ABI for whole pictures and regions of them: checks, then stripe by stripe.
#include <cstring>

#include "lib/engine.h"
#include "lib/layout.h"
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

// Whether `out` overlaps the workspace or the light field.
bool OutputOverlaps(const EngineState& engine, const sf_light_field& light_field,
                    const Output& out) {
  const sf_config& config = engine.config;
  const Extent extent = ExtentOf(out.data, out.stride, out.region.height, out.RowBytes());
  if (Overlaps(extent, Workspace(engine))) return true;
  for (int view = 0; view < config.views; ++view) {
    const sf_plane& plane = light_field.views[view];
    if (Overlaps(extent, ExtentOf(plane.data, plane.stride, config.height,
                                  3 * static_cast<size_t>(config.width)))) {
      return true;
    }
  }
  return Overlaps(extent,
                  ExtentOf(light_field.disparity, light_field.disparity_stride, config.height,
                           sizeof(float) * static_cast<size_t>(config.width)));
}

const float* DisparityRow(const sf_light_field& light_field, int32_t y) {
  return light_field.disparity +
         static_cast<size_t>(y) * (light_field.disparity_stride / sizeof(float));
}

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

sf_status RefocusPicture(EngineState* engine, const sf_light_field& light_field, const Output& out,
                         const Runner& runner) {
  const int32_t height = engine->config.height, side = engine->config.largest_block;
  Plane<const uint8_t> views[kMaxViews];
  for (int view = 0; view < engine->config.views; ++view) {
    views[view] = {light_field.views[view].data, light_field.views[view].stride, 0, 0};
  }
  SetViews(views, engine);
  const RowRange stripes = StripeRows(*engine);
  const bool whole = IsWhole(engine->params.region);
  engine->disparity_rows = Max(0, stripes.first - engine->reach.rows);
  for (int32_t y = stripes.first; y < stripes.last; y += side) {
    const int32_t needed = Min(height, y + side + engine->reach.rows);
    while (engine->disparity_rows < needed) {
      const sf_status status =
          PushDisparity(DisparityRow(light_field, engine->disparity_rows), engine);
      if (status != SF_OK) return status;
    }
    const sf_status status = whole ? RefocusStripe(engine, y, {out.data, out.stride, 0, 0}, runner)
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

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus(sf_engine* engine, const sf_params* params, const sf_light_field* light_field,
                     uint8_t* out, size_t out_stride, sf_runner runner, void* runner_data,
                     sf_report* report) {
  if (engine == nullptr || params == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  EngineState& e = *reinterpret_cast<EngineState*>(engine);
  sf_status status = starfocus::CheckParams(*params);
  if (status == SF_OK) status = starfocus::CheckRegion(e.config, params->region);
  if (status == SF_OK) status = starfocus::CheckLightField(e.config, *light_field);
  if (status != SF_OK) return status;
  const starfocus::Output output = {out, out_stride, starfocus::RegionOf(e.config, *params)};
  status = starfocus::CheckOutput(output.region.width, output.region.height, out, out_stride);
  if (status != SF_OK) return status;
  if (starfocus::OutputOverlaps(e, *light_field, output)) return SF_ERROR_OVERLAP;
  e.stream.active = false;
  status = starfocus::SetLens(*params, &e);
  if (status == SF_OK) status = starfocus::CheckDisparity(e, *light_field);
  if (status != SF_OK) return status;
  status = starfocus::RefocusPicture(&e, *light_field, output, {runner, runner_data});
  if (status == SF_OK && report != nullptr) *report = starfocus::GetReport(e);
  return status;
}
