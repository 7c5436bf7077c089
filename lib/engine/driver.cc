// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/driver.h"

#include <cstring>

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/base/problem.h"
#include "lib/engine/stripe.h"
#include "simd/depth_values.h"

namespace starfocus {
namespace {

// Reads rows of the disparity map and the centre view. Job `index` reads part `index` of the rows,
// as PartOf divides them.
struct RowsJob {
  const RowSource* source;
  const EngineState* engine;
  RowRange rows;
  int32_t jobs;
  Plane<int16_t> disparity;  // output: disparities of the rows
};

void ReadMap(const RowsJob& job, int32_t y, int16_t* row, Counts* counts) {
  counts->depth_flags |= job.source->map(job.source->self, y, row);
}

// Checks part `index` of the rows of the disparity map. Each job reads all of its map rows into a
// single row of the ring.
void CheckPart(const RowsJob& job, int32_t index, Scratch* scratch) {
  const RowRange rows = PartOf(job.rows, index, job.jobs);
  for (int32_t y = rows.first; y < rows.last; ++y) {
    if (!scratch->cancel.Spend(job.engine->config.width)) return;
    ReadMap(job, y, job.disparity.Row(index), &scratch->counts);
  }
}

// Copies the 8-bit codes of row y of a view to `to`.
void CopyCodes(const RowSource& source, int view, int32_t y, int32_t width, uint8_t* to) {
  const uint8_t* const codes = source.views.Codes(view, 0, y, width, to);
  if (codes != to) std::memcpy(to, codes, 3 * static_cast<size_t>(width));
}

// Fills the unknown disparities of a row if the configuration enables it.
void FinishMapRow(const EngineState& engine, int16_t* row, Counts* counts) {
  if (Has(engine.config.features, STARFOCUS_FEATURE_FILL_UNKNOWN)) {
    counts->unknown_pixels +=
        static_cast<uint64_t>(FillUnknown(engine.config, *engine.kernels, row));
  }
  CheckAll(ranges::kDisparity, row, static_cast<size_t>(engine.config.width));
}

void LoadPart(const RowsJob& job, int32_t index, Scratch* scratch) {
  const EngineState& engine = *job.engine;
  const int32_t width = engine.config.width;
  const RowRange rows = PartOf(job.rows, index, job.jobs);
  for (int32_t y = rows.first; y < rows.last; ++y) {
    if (!scratch->cancel.Spend(4 * int64_t{width})) return;
    if (job.source->converts_centre) CopyCodes(*job.source, 0, y, width, engine.rings[0].Row(y));
    if (job.source->map == nullptr) continue;
    ReadMap(job, y, job.disparity.Row(y), &scratch->counts);
    FinishMapRow(engine, job.disparity.Row(y), &scratch->counts);
  }
}

starfocus_status StatusOf(uint32_t flags, const starfocus_config& config) {
  Checker check(config.problem);
  check.Need(
      (flags & simd::kUnknownDepth) == 0 || Has(config.features, STARFOCUS_FEATURE_FILL_UNKNOWN),
      STARFOCUS_ERROR_NOT_FINITE, {"disparity"}, {"finite, or STARFOCUS_FEATURE_FILL_UNKNOWN"});
  check.Need((flags & simd::kDepthOutside) == 0, STARFOCUS_ERROR_DISPARITY, {"disparity"},
             {"disparity_min to disparity_max", config.disparity_min, config.disparity_max});
  return check.status();
}

template <void (*kJob)(const RowsJob&, int32_t, Scratch*)>
starfocus_status RunRows(const RowsJob& job, EngineState* engine) {
  const starfocus_status status = RunJobs<RowsJob, kJob>(job, job.jobs, &engine->workers);
  uint32_t flags = 0;
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    flags |= engine->workers.scratch[worker].counts.depth_flags;
  }
  TakeCounts(engine);
  return status != STARFOCUS_OK ? status : StatusOf(flags, engine->config);
}

}  // namespace

RowRange StripeRows(const EngineState& engine) {
  const Rect& region = engine.lens.region;
  const int32_t reach = engine.lens.borders.joined;
  const int32_t side = engine.config.superblock;
  return {Max(0, region.y - reach) / side * side,
          Min(engine.config.height, region.y + region.height + reach)};
}

RowRange PartOf(const RowRange& rows, int32_t index, int32_t parts) {
  const int64_t count = rows.last - rows.first;
  return {rows.first + static_cast<int32_t>(count * index / parts),
          rows.first + static_cast<int32_t>(count * (index + 1) / parts)};
}

starfocus_status CheckRows(const RowSource& source, const RowRange& rows, EngineState* engine) {
  if (source.map == nullptr) return STARFOCUS_OK;
  const Plane<int16_t>& ring = engine->row_store.disparity;
  const int32_t jobs = Min(Min(MaxJobs(engine->config), ring.rows), rows.last - rows.first);
  return RunRows<CheckPart>({&source, engine, rows, jobs, ring}, engine);
}

starfocus_status LoadRows(const RowSource& source, const RowRange& rows,
                          const Plane<int16_t>& disparity, EngineState* engine) {
  if (rows.first >= rows.last || (source.map == nullptr && !source.converts_centre))
    return STARFOCUS_OK;
  const int32_t jobs = Min(MaxJobs(engine->config), rows.last - rows.first);
  return RunRows<LoadPart>({&source, engine, rows, jobs, disparity}, engine);
}

starfocus_status CopyRow(const RowSource& source, int32_t y, EngineState* engine) {
  const starfocus_config& config = engine->config;
  int16_t* const row = engine->row_store.disparity.Row(y);
  Counts& counts = engine->workers.scratch[0].counts;
  counts.depth_flags = source.map(source.self, y, row);
  const starfocus_status status = StatusOf(counts.depth_flags, config);
  if (status == STARFOCUS_OK) FinishMapRow(*engine, row, &counts);
  TakeCounts(engine);
  if (status != STARFOCUS_OK) return status;
  for (int view = 0; view < config.views; ++view) {
    CopyCodes(source, view, y, config.width, engine->rings[view].Row(y));
  }
  const Plane<uint8_t>& coverage = engine->stripe.coverage.given;
  if (source.coverage != nullptr && coverage.data != nullptr) {
    source.coverage(source.self, y, coverage.Row(y));
  }
  const Plane<uint8_t>& alpha = engine->images.alpha;
  if (alpha.data == nullptr) return STARFOCUS_OK;
  std::memset(alpha.Row(y), 255, alpha.stride);
  if (source.alpha != nullptr) source.alpha(source.self, y, alpha.Row(y));
  return STARFOCUS_OK;
}

starfocus_status RefocusRows(const RowSource& source, const RowSink& sink, EngineState* engine) {
  const starfocus_config& config = engine->config;
  const Lens& lens = engine->lens;
  const int32_t side = config.superblock, reach = lens.borders.centre, top = lens.region.y;
  const int32_t bottom = top + lens.region.height;
  const RowRange stripes = StripeRows(*engine);
  RowRange rows = {Max(0, stripes.first - reach), 0};
  // First row of the last stripe of the region.
  const int32_t last = (stripes.last - 1) / side * side;
  rows.last = Min(config.height, last + side + reach);
  starfocus_status status = CheckRows(source, rows, engine);
  for (int32_t y = stripes.first; y <= last && status == STARFOCUS_OK; y += side) {
    rows.last = Min(config.height, y + side + reach);
    status = LoadRows(source, rows, engine->row_store.disparity, engine);
    rows.first = rows.last;
    if (status == STARFOCUS_OK && engine->stripe.changes.active) {
      status = CompareRows(y, &engine->workers.scratch[0].cancel, &engine->stripe.changes);
    }
    if (status == STARFOCUS_OK) status = RefocusStripe(engine, y);
    if (status != STARFOCUS_OK) break;
    // The next stripe may change the last rows of this stripe. The last stripe of the region has no
    // next stripe.
    const int32_t end = y == last ? bottom : Min(FinishedRows(config, y), bottom);
    const RowRange finished = {Max(y - kDeblockRows, top), end};
    if (finished.first < end) {
      status = sink.store(sink.self, finished, BufferRows(*engine, y), engine);
    }
    if (status == STARFOCUS_OK) engine->workers.jobs.call_progress.SetRows(Max(0, end - top));
  }
  if (status != STARFOCUS_OK) return status;
  return engine->workers.jobs.call_progress.Ask() ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED;
}

}  // namespace starfocus
