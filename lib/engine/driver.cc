// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/driver.h"

#include <cstring>

#include "lib/base/features.h"
#include "lib/base/fixed.h"
#include "lib/base/problem.h"
#include "lib/engine/jobs.h"
#include "lib/engine/stripe.h"
#include "lib/io/rows.h"
#include "simd/depth_values.h"

namespace starfocus {
namespace {

// Reads rows of the disparity map and the centre view. Job `index` reads part `index` of the rows,
// as PartOf divides them.
struct RowsJob {
  const RowSource* source;
  const EngineState* engine;
  Range rows;
  int32_t jobs;
  Plane<int16_t> disparity;  // Output of LoadPart: disparities of the rows.
};

// Number of rows that are read together. Rows of a group share values of a map that is smaller than
// the picture. With groups of 8 rows, a superblock still has several jobs for all workers.
constexpr int32_t kGroupRows = 8;

// Returns the number of jobs that read a number of rows.
int32_t JobsOf(const Range& rows, const starfocus_config& config) {
  return Min(MaxJobs(config), (rows.last - rows.first + kGroupRows - 1) / kGroupRows);
}

// Calls act(rows) for groups of rows of part `index`. Stops after cancellation.
template <class Act>
void ForGroups(const RowsJob& job, int32_t index, Scratch* scratch, const Act& act) {
  const Range rows = PartOf(job.rows, index, job.jobs);
  for (int32_t y = rows.first; y < rows.last; y += kGroupRows) {
    const Range part = {y, Min(y + kGroupRows, rows.last)};
    const int64_t pixels = int64_t{job.engine->config.width} * (part.last - part.first);
    if (!scratch->cancel.Spend(4 * pixels)) return;
    act(part);
  }
}

// Checks part `index` of the rows of the disparity map.
void CheckPart(const RowsJob& job, int32_t index, Scratch* scratch) {
  ForGroups(job, index, scratch, [&](const Range& rows) {
    scratch->counts.depth_flags |= job.source->check_map(job.source->self, rows);
  });
}

// Copies the 8-bit codes of row y of a view to `to`.
void CopyCodes(const RowSource& source, int view, int32_t y, int32_t width, uint8_t* to) {
  const uint8_t* const codes = source.views.Codes(view, 0, y, width, to);
  if (codes != to) std::memcpy(to, codes, 3 * static_cast<size_t>(width));
}

// Fills the unknown disparities of converted rows of the map if the configuration enables it.
void FillRows(const EngineState& engine, const Range& rows, const Plane<int16_t>& disparity,
              Counts* counts) {
  for (int32_t y = rows.first; y < rows.last; ++y) {
    int16_t* const row = disparity.Row(y);
    if (Has(engine.config.features, STARFOCUS_FEATURE_FILL_UNKNOWN)) {
      counts->unknown_pixels +=
          static_cast<uint64_t>(FillUnknown(engine.config, *engine.kernels, row));
    }
    CheckAll(ranges::kDisparity, row, static_cast<size_t>(engine.config.width));
  }
}

void LoadPart(const RowsJob& job, int32_t index, Scratch* scratch) {
  const EngineState& engine = *job.engine;
  const RowSource& source = *job.source;
  ForGroups(job, index, scratch, [&](const Range& rows) {
    for (int32_t y = rows.first; source.converts_centre && y < rows.last; ++y) {
      CopyCodes(source, 0, y, engine.config.width, engine.rings[0].Row(y));
    }
    if (source.map == nullptr) return;
    scratch->counts.depth_flags |= source.map(source.self, rows, job.disparity);
    FillRows(engine, rows, job.disparity, &scratch->counts);
  });
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
  const starfocus_status status = RunJobs<RowsJob, kJob>(job, job.jobs, engine);
  uint32_t flags = 0;
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    flags |= engine->scratch[worker].counts.depth_flags;
  }
  TakeCounts(engine);
  return status != STARFOCUS_OK ? status : StatusOf(flags, engine->config);
}

// Copies row y of the previous picture, and then the columns of `from` that may have changed.
void StoreChanged(const Output& out, const Plane<uint8_t>& from, int32_t y,
                  const EngineState& engine) {
  const Rect& rect = out.rect;
  const FrameDiff& changes = engine.stripe.changes;
  const int32_t side = changes.side, reach = engine.lens.borders.joined;
  std::memcpy(out.image.Pixel(0, y - rect.y), RowsOf(*changes.picture, rect.y).Row(y),
              3 * static_cast<size_t>(rect.width));
  for (int32_t x = 0; x < changes.width; x += side) {
    if (!HasChanged(changes, {x, y - reach, side, 1 + 2 * reach})) continue;
    CopyColumns(out, from, y, Max(x - reach, rect.x), Min(x + side + reach, rect.x + rect.width));
  }
}

starfocus_status Store(const Output& out, const Range& rows, const Plane<uint8_t>& from,
                       EngineState* engine) {
  if (!engine->stripe.changes.active) {
    return StoreRows(out, rows, from, MaxJobs(engine->config), engine->jobs);
  }
  for (int32_t y = rows.first; y < rows.last; ++y) StoreChanged(out, from, y, *engine);
  return STARFOCUS_OK;
}

}  // namespace

Range StripeRows(const EngineState& engine) {
  const Rect& region = engine.lens.region;
  const int32_t reach = engine.lens.borders.joined;
  const int32_t side = engine.config.superblock;
  return {Max(0, region.y - reach) / side * side,
          Min(engine.config.height, region.y + region.height + reach)};
}

starfocus_status CheckRows(const RowSource& source, const Range& rows, EngineState* engine) {
  if (source.check_map == nullptr) return STARFOCUS_OK;
  const int32_t jobs = JobsOf(rows, engine->config);
  return RunRows<CheckPart>({&source, engine, rows, jobs, {}}, engine);
}

starfocus_status LoadRows(const RowSource& source, const Range& rows,
                          const Plane<int16_t>& disparity, EngineState* engine) {
  if (rows.first >= rows.last || (source.map == nullptr && !source.converts_centre))
    return STARFOCUS_OK;
  const int32_t jobs = JobsOf(rows, engine->config);
  return RunRows<LoadPart>({&source, engine, rows, jobs, disparity}, engine);
}

starfocus_status CopyRow(const RowSource& source, int32_t y, EngineState* engine) {
  const starfocus_config& config = engine->config;
  const Range row = {y, y + 1};
  const Plane<int16_t>& disparity = engine->row_store.disparity;
  const starfocus_status status = StatusOf(source.map(source.self, row, disparity), config);
  if (status != STARFOCUS_OK) return status;
  FillRows(*engine, row, disparity, &engine->scratch[0].counts);
  TakeCounts(engine);
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

starfocus_status RefocusRows(const RowSource& source, const Output& out, EngineState* engine) {
  const starfocus_config& config = engine->config;
  const Lens& lens = engine->lens;
  const int32_t side = config.superblock, reach = lens.borders.centre, top = lens.region.y;
  const int32_t bottom = top + lens.region.height;
  const Range stripes = StripeRows(*engine);
  Range rows = {Max(0, stripes.first - reach), 0};
  // First row of the last stripe of the region.
  const int32_t last = (stripes.last - 1) / side * side;
  rows.last = Min(config.height, last + side + reach);
  starfocus_status status = CheckRows(source, rows, engine);
  for (int32_t y = stripes.first; y <= last && status == STARFOCUS_OK; y += side) {
    rows.last = Min(config.height, y + side + reach);
    status = LoadRows(source, rows, engine->row_store.disparity, engine);
    rows.first = rows.last;
    if (status == STARFOCUS_OK && engine->stripe.changes.active) {
      status = CompareRows(y, &engine->scratch[0].cancel, &engine->stripe.changes);
    }
    if (status == STARFOCUS_OK) status = RefocusStripe(engine, y);
    if (status != STARFOCUS_OK) break;
    // The next stripe may change the last rows of this stripe. The last stripe of the region has no
    // next stripe.
    const int32_t end = y == last ? bottom : Min(FinishedRows(config, y), bottom);
    const Range finished = {Max(y - kDeblockRows, top), end};
    if (finished.first < end) {
      status = Store(out, finished, BufferRows(*engine, y), engine);
    }
    if (status == STARFOCUS_OK) engine->jobs->call_progress.SetRows(Max(0, end - top));
  }
  if (status != STARFOCUS_OK) return status;
  return engine->jobs->call_progress.Ask() ? STARFOCUS_OK : STARFOCUS_ERROR_CANCELLED;
}

}  // namespace starfocus
