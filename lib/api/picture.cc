// SPDX-License-Identifier: Apache-2.0
// The C ABI for whole pictures and regions of them: checks, then stripe by stripe.
#include <cstring>

#include "lib/api/light_field.h"
#include "lib/api/prepared.h"
#include "lib/api/stripe_rows.h"
#include "lib/api/validate.h"
#include "lib/engine/engine.h"
#include "lib/engine/layout.h"
#include "lib/engine/lens.h"
#include "lib/engine/stripe.h"
#include "starfocus/starfocus.h"

namespace starfocus {
namespace {

// Where the rows of the region go.
struct Output {
  uint8_t* data;
  size_t stride;
  Rect region;

  size_t RowBytes() const { return 3 * static_cast<size_t>(region.width); }
  uint8_t* At(int32_t x, int32_t y) const {
    return data + static_cast<size_t>(y - region.y) * stride +
           3 * static_cast<size_t>(x - region.x);
  }
};

// Checks the rows of the map that may be read, before the first pixel is written. The last ones
// come first, so that the ring is left with those that the first stripes read.
sf_status CheckDisparity(const sf_light_field& light_field, EngineState* engine) {
  const RowRange rows = MapRows(*engine);
  for (int32_t y = rows.last - 1; y >= rows.first; --y) {
    if (!OwnPatience(engine)->Spend(engine->config.width)) return SF_ERROR_CANCELLED;
    int32_t unknown = 0;
    const sf_status status = ReadDisparity(DisparityRow(light_field, y), y, engine, &unknown);
    if (status != SF_OK) return status;
    engine->report.unknown_pixels += static_cast<uint64_t>(unknown);
  }
  engine->pictures.disparity_rows = Min(rows.last, rows.first + engine->pictures.disparity.rows);
  return SF_OK;
}

// Copies what changed of a row from the engine's own rows.
void WriteChanges(const EngineState& engine, const Plane<uint8_t>& rows, int32_t row,
                  const Output& out) {
  const Rect& region = out.region;
  const int32_t side = engine.config.largest_block, reach = JoinReach(engine.config, engine.lens);
  for (int32_t column = 0; column < Columns(engine.config); ++column) {
    const int32_t x = column * side;
    if (!HasChanged(engine.stripe.changes, {x, row - reach, side, 1 + 2 * reach})) continue;
    const int32_t first = Max(x - reach, region.x);
    const int32_t last = Min(x + side + reach, region.x + region.width);
    if (first >= last) continue;
    std::memcpy(out.At(first, row), rows.Row(row) + 3 * static_cast<size_t>(first),
                3 * static_cast<size_t>(last - first));
  }
}

// Writes rows of the region, up to row `end`, that the stripe at row y finished in the engine's own
// rows; what they have not comes from the picture before.
void WriteRows(const EngineState& engine, int32_t y, int32_t end, const sf_previous* before,
               const Output& out) {
  const Plane<uint8_t> rows = BufferRows(engine, y);
  const Rect& region = out.region;
  for (int32_t row = Max(y - kDeblockRows, region.y); row < end; ++row) {
    if (before == nullptr) {
      std::memcpy(out.At(region.x, row), rows.Row(row) + 3 * static_cast<size_t>(region.x),
                  out.RowBytes());
    } else {
      std::memcpy(out.At(region.x, row),
                  before->out + static_cast<size_t>(row - region.y) * before->out_stride,
                  out.RowBytes());
      WriteChanges(engine, rows, row, out);
    }
  }
}

// Converts the rows that the stripe at row y reads and that are not in the ring. They were good
// when they were checked.
sf_status ReadRows(const sf_light_field& light_field, int32_t y, EngineState* engine) {
  const int32_t needed =
      Min(engine->config.height, y + engine->config.largest_block + engine->lens.reach.rows);
  for (; engine->pictures.disparity_rows < needed; ++engine->pictures.disparity_rows) {
    const int32_t row = engine->pictures.disparity_rows;
    int32_t unknown = 0;  // counted when the row was checked
    const sf_status status = ReadDisparity(DisparityRow(light_field, row), row, engine, &unknown);
    if (status != SF_OK) return status;
  }
  return SF_OK;
}

// A refocusing as the C ABI asks for it; prepared and previous may be null.
struct Request {
  const sf_params* params;
  const sf_light_field* light_field;
  const Prepared* prepared;
  const sf_previous* previous;
  uint8_t* out;
  size_t out_stride;
  Runner runner;
};

// Sets up the comparison with the light field before.
void UsePrevious(const Request& request, EngineState* engine) {
  const sf_config& config = engine->config;
  Changes& changes = engine->stripe.changes;
  changes.active = true;
  changes.before = &request.previous->light_field;
  changes.now = request.light_field;
  // Depth-dependent blur is that of the centre view.
  changes.views = request.params->mode == SF_MODE_BLUR ? 1 : config.views;
  changes.fills = config.fill_unknown != 0;
  changes.width = config.width;
  changes.height = config.height;
  changes.side = engine->config.largest_block;
  changes.side_reach = SideReach(config, engine->report.r_max);
  changes.centre_reach = HighlightReach(config) > 0 ? changes.side_reach : engine->lens.reach.rows;
  StartChanges(StripeRows(*engine).first, &changes);
}

sf_status RefocusStripes(const Request& request, EngineState* engine) {
  const int32_t side = engine->config.largest_block;
  const RowRange stripes = StripeRows(*engine);
  const Output out = {request.out, request.out_stride, engine->lens.region};
  const bool direct = IsWhole(request.params->region) && request.previous == nullptr;
  Watch& watch = engine->crew.jobs.watch;
  for (int32_t y = stripes.first; y < stripes.last; y += side) {
    sf_status status =
        request.prepared != nullptr ? SF_OK : ReadRows(*request.light_field, y, engine);
    if (status != SF_OK) return status;
    if (request.previous != nullptr) {
      status = CompareRows(y, OwnPatience(engine), &engine->stripe.changes);
      if (status != SF_OK) return status;
    }
    status = direct ? RefocusStripe(engine, y, {out.data, out.stride, 0, 0}, request.runner)
                    : RefocusIntoBuffer(engine, y, request.runner);
    if (status != SF_OK) return status;
    // The stripe after the last one changes nothing of the region.
    const int32_t region_end = out.region.y + out.region.height;
    const int32_t end =
        y + side >= stripes.last ? region_end : Min(FinishedRows(engine->config, y), region_end);
    if (!direct) WriteRows(*engine, y, end, request.previous, out);
    watch.SetRows(Max(0, end - out.region.y));
  }
  return watch.Ask() ? SF_OK : SF_ERROR_CANCELLED;
}

sf_status CheckPictures(const Request& request, const Rect& region, const sf_config& config) {
  sf_status status = CheckLightField(config, *request.light_field);
  if (status == SF_OK) {
    status = CheckOutput(region.width, region.height, request.out, request.out_stride);
  }
  if (status != SF_OK || request.previous == nullptr) return status;
  const sf_previous& previous = *request.previous;
  status = CheckLightField(config, previous.light_field);
  if (status != SF_OK) return status;
  return CheckOutput(region.width, region.height, previous.out, previous.out_stride);
}

// Whether the output overlaps the workspace or anything that is read.
bool OutputOverlaps(const Request& request, const Rect& region, const EngineState& engine) {
  const size_t row_bytes = 3 * static_cast<size_t>(region.width);
  const Extent out = ExtentOf(request.out, request.out_stride, region.height, row_bytes);
  if (Overlaps(out, Workspace(engine)) ||
      OverlapsLightField(out, engine.config, *request.light_field)) {
    return true;
  }
  if (request.prepared != nullptr && Overlaps(out, PreparedMemory(*request.prepared))) return true;
  if (request.previous == nullptr) return false;
  const sf_previous& previous = *request.previous;
  return OverlapsLightField(out, engine.config, previous.light_field) ||
         Overlaps(out, ExtentOf(previous.out, previous.out_stride, region.height, row_bytes));
}

sf_status CheckRequest(const Request& request, const EngineState& engine) {
  const sf_config& config = engine.config;
  sf_status status = CheckParams(config, *request.params);
  if (status == SF_OK) status = CheckRegion(config, request.params->region);
  if (status != SF_OK) return status;
  if (request.prepared != nullptr && !Fits(*request.prepared, config)) return SF_ERROR_PREPARED;
  const Rect region = RegionOf(config, *request.params);
  status = CheckPictures(request, region, config);
  if (status != SF_OK) return status;
  return OutputOverlaps(request, region, engine) ? SF_ERROR_OVERLAP : SF_OK;
}

sf_status Refocus(const Request& request, EngineState* engine, sf_report* report) {
  sf_status status = CheckRequest(request, *engine);
  if (status != SF_OK) return status;
  engine->stream.active = false;
  const sf_params& params = *request.params;
  engine->crew.jobs.watch.Begin(params.progress, params.progress_data, 0,
                                RegionOf(engine->config, params).height);
  status = SetLens(*request.params, engine);
  if (status != SF_OK) return status;
  SetPictures(*request.light_field, engine);
  if (request.prepared != nullptr) {
    UsePrepared(*request.prepared, engine);
  } else {
    status = CheckDisparity(*request.light_field, engine);
    if (status != SF_OK) return status;
  }
  if (request.previous != nullptr) UsePrevious(request, engine);
  status = RefocusStripes(request, engine);
  if (status == SF_OK && report != nullptr) *report = engine->report;
  return status;
}

}  // namespace
}  // namespace starfocus

using starfocus::EngineState;

sf_status sf_refocus(sf_engine* engine, const sf_params* params, const sf_light_field* light_field,
                     uint8_t* out, size_t out_stride, sf_runner runner, void* runner_data,
                     sf_report* report) {
  if (engine == nullptr || params == nullptr || light_field == nullptr) return SF_ERROR_NULL;
  return starfocus::Refocus(
      {params, light_field, nullptr, nullptr, out, out_stride, {runner, runner_data}},
      reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_after(sf_engine* engine, const sf_params* params,
                           const sf_light_field* light_field, const sf_previous* previous,
                           uint8_t* out, size_t out_stride, sf_runner runner, void* runner_data,
                           sf_report* report) {
  if (engine == nullptr || params == nullptr || light_field == nullptr || previous == nullptr) {
    return SF_ERROR_NULL;
  }
  return starfocus::Refocus(
      {params, light_field, nullptr, previous, out, out_stride, {runner, runner_data}},
      reinterpret_cast<EngineState*>(engine), report);
}

sf_status sf_refocus_prepared(sf_engine* engine, const sf_params* params,
                              const sf_prepared* prepared, uint8_t* out, size_t out_stride,
                              sf_runner runner, void* runner_data, sf_report* report) {
  if (engine == nullptr || params == nullptr || prepared == nullptr) return SF_ERROR_NULL;
  const auto* p = reinterpret_cast<const starfocus::Prepared*>(prepared);
  if (p->images != nullptr) return SF_ERROR_PREPARED;
  return starfocus::Refocus(
      {params, &p->light_field, p, nullptr, out, out_stride, {runner, runner_data}},
      reinterpret_cast<EngineState*>(engine), report);
}
