// SPDX-License-Identifier: Apache-2.0
// Reads the rows of the map that stripes depend on, and refocuses whole pictures.
#include <cstring>

#include "lib/base/fixed.h"
#include "lib/base/problem.h"
#include "lib/engine/stripe.h"
#include "lib/io/output.h"
#include "simd/depth_values.h"

namespace starfocus {
namespace {

// Number of rows that are read together. Rows of a group share values of a map that is smaller than
// the picture. With groups of 8 rows, a superblock still has several jobs for all workers.
constexpr int32_t kRowsAtOnce = 8;

// Copies row y of the previous picture, and then the columns of `from` that may have changed.
void StoreChanged(const Output& out, const Plane<uint8_t>& from, int32_t y,
                  const EngineState& engine) {
  const Rect& rect = out.rect;
  const FrameDiff& changes = engine.stripe.changes;
  const int32_t side = engine.config.superblock, reach = engine.lens.borders.deblocked;
  std::memcpy(out.image.Pixel(0, y - rect.y), RowsOf(*changes.picture, rect.y).Row(y),
              3 * static_cast<size_t>(rect.width));
  for (int32_t x = 0; x < engine.config.width; x += side) {
    if (!HasChanged(changes, {x, y - reach, side, 1 + 2 * reach})) continue;
    CopyColumns(out, from, y, Max(x - reach, rect.x), Min(x + side + reach, rect.x + rect.width));
  }
}

starfocus_status Store(const Output& out, const Range& rows, const PictureRows& from,
                       EngineState* engine) {
  if (engine->stripe.changes.before == nullptr) {
    return StoreRows(out, rows, from, MaxJobs(engine->config), engine->jobs);
  }
  for (int32_t y = rows.first; y < rows.last; ++y) StoreChanged(out, from.codes, y, *engine);
  return STARFOCUS_OK;
}

}  // namespace

Range StripeRows(const EngineState& engine) {
  const Rect& region = engine.lens.region;
  const int32_t reach = engine.lens.borders.deblocked;
  const int32_t side = engine.config.superblock;
  return {Max(0, region.y - reach) / side * side,
          Min(engine.config.height, region.y + region.height + reach)};
}

starfocus_status CheckFlags(uint32_t flags, const FullConfig& config) {
  Checker check(config.problem);
  check.Need((flags & simd::kUnknownDepth) == 0 || config.unknown == STARFOCUS_UNKNOWN_FILL,
             STARFOCUS_ERROR_NOT_FINITE, {"disparity"}, {"finite, or STARFOCUS_UNKNOWN_FILL"});
  check.Need((flags & simd::kDepthOutside) == 0, STARFOCUS_ERROR_DISPARITY, {"disparity"},
             {"disparity_min to disparity_max", config.disparity_min, config.disparity_max});
  return check.status();
}

starfocus_status ReadRows(const Range& rows, const Plane<int16_t>* disparity, EngineState* engine) {
  const FullConfig& config = engine->config;
  const Input& in = engine->input;
  const bool has_map = in.map.map.data != nullptr;
  const bool converts = (in.converts_centre || in.is_deep()) && disparity != nullptr;
  if (rows.first >= rows.last || !(has_map || converts)) return STARFOCUS_OK;
  const int32_t jobs =
      Min(MaxJobs(config), (rows.last - rows.first + kRowsAtOnce - 1) / kRowsAtOnce);
  const auto read = [&](int32_t index, int32_t worker) {
    Scratch& scratch = engine->scratch[worker];
    const Range part = PartOf(rows, index, jobs);
    for (int32_t y = part.first; y < part.last; y += kRowsAtOnce) {
      const Range group = {y, Min(y + kRowsAtOnce, part.last)};
      if (!scratch.cancel.Spend(int64_t{4} * config.width * (group.last - y))) return;
      for (int32_t row = y; converts && row < group.last; ++row) {
        ConvertRow(in, row, false, engine->rings);
      }
      if (!has_map) continue;
      scratch.counts.converted_pixels += PixelsIn(config.width, group.count());
      scratch.counts.depth_flags |= ReadMap(in, group, disparity, &scratch.counts.unknown_pixels);
    }
  };
  const starfocus_status status = ForEach(jobs, engine->jobs, read);
  uint32_t flags = 0;
  for (int32_t worker = 0; worker < config.max_workers; ++worker) {
    flags |= engine->scratch[worker].counts.depth_flags;
  }
  ReportCounts(engine);
  return status != STARFOCUS_OK ? status : CheckFlags(flags, config);
}

starfocus_status RefocusRows(const Output& out, EngineState* engine) {
  const FullConfig& config = engine->config;
  const Lens& lens = engine->lens;
  const int32_t side = config.superblock, reach = lens.borders.centre, top = lens.region.y;
  const int32_t bottom = top + lens.region.height;
  const Range stripes = StripeRows(*engine);
  // First row of the last stripe of the region.
  const int32_t last = (stripes.last - 1) / side * side;
  CallProgress& call_progress = engine->jobs->call_progress;
  const auto refocus = [&](int32_t y, const Range& read) {
    starfocus_status status = ReadRows(read, &engine->rings.disparity, engine);
    if (status == STARFOCUS_OK && engine->stripe.changes.before != nullptr) {
      status = CompareRows(y, &engine->scratch[0].cancel, &engine->stripe.changes);
    }
    if (status == STARFOCUS_OK) status = RefocusStripe(engine, y);
    if (status != STARFOCUS_OK) return status;
    // The next stripe may change the last rows of this stripe. The last stripe of the region has no
    // next stripe.
    const int32_t end = y == last ? bottom : Min(FinishedRows(config, y), bottom);
    const Range finished = {Max(y - kDeblockRows, top), end};
    if (finished.first < end) status = Store(out, finished, BufferRows(*engine, y), engine);
    if (status == STARFOCUS_OK) call_progress.SetRows(Max(0, end - top));
    return status;
  };
  const Range rows = {Max(0, stripes.first - reach), Min(config.height, last + side + reach)};
  starfocus_status status = ReadRows(rows, nullptr, engine);
  if (status == STARFOCUS_OK) {
    status = ForStripes(stripes, reach, config.height, config, refocus);
  }
  if (status != STARFOCUS_OK) return status;
  return call_progress.Ask() ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED;
}

}  // namespace starfocus
