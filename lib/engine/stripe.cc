// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/stripe.h"

#include <algorithm>
#include <cstring>

#include "lib/matting/coverage.h"

namespace starfocus {
namespace {

// Deblocks the boundaries between blocks of different layers: first boundaries between rows, with
// one job per column of superblocks, then boundaries between columns, with one job per
// kSmallestBlock finished rows.
starfocus_status Deblock(const Range& stripe, const PictureRows& out, EngineState* engine) {
  const FullConfig& config = engine->config;
  const Deblocking deblocking = {&engine->stripe.map,    out,
                                 config.width,           config.height,
                                 stripe.first,           config.tuning.deblocking,
                                 engine->input.transfer, engine->kernels};
  const int32_t smallest = config.superblock / kSmallestBlock;
  const starfocus_status status =
      ForEach(Columns(config), engine->jobs, [&](int32_t column, int32_t) {
        DeblockRowBoundaries(deblocking, {column * smallest, Min((column + 1) * smallest,
                                                                 engine->stripe.map.columns)});
      });
  const Range finished = {Max(0, stripe.first - kDeblockRows), FinishedRows(config, stripe.first)};
  if (status != STARFOCUS_OK || finished.count() <= 0) return status;
  const int32_t jobs = (finished.count() + kSmallestBlock - 1) / kSmallestBlock;
  return ForEach(jobs, engine->jobs, [&](int32_t index, int32_t) {
    const int32_t first = finished.first + index * kSmallestBlock;
    DeblockColumnBoundaries(deblocking, {first, Min(first + kSmallestBlock, finished.last)});
  });
}

// Finds the coverage and the rims of the rows that the blocks of the stripe read. Only the slice
// renderer uses them.
starfocus_status FindMixedPixels(const Range& stripe, EngineState* engine) {
  const FullConfig& config = engine->config;
  const Lens& lens = engine->lens;
  StripeState& state = engine->stripe;
  const bool uses =
      lens.renderer->gathers && lens.params.mode != STARFOCUS_MODE_BLUR && !IsPinhole(lens);
  const bool covers = uses && Has(config, STARFOCUS_FEATURE_COVERAGE);
  const bool has_rims = uses && HasRims(config);
  const auto around = [&](int32_t border) {
    return Range{stripe.first - border, stripe.last + border};
  };
  engine->input.coverage = covers ? &state.coverage : nullptr;
  starfocus_status status = STARFOCUS_OK;
  if (covers) {
    status = FindCoverage(config, engine->input, around(lens.borders.matting), engine->jobs,
                          &state.coverage);
  }
  engine->input.rims = has_rims ? &state.rims : nullptr;
  if (!has_rims || status != STARFOCUS_OK) return status;
  return FindRims(config, engine->input, around(lens.borders.layer[0]), engine->jobs, &state.rims);
}

starfocus_status RefocusPhases(const Range& stripe, const PictureRows& out, EngineState* engine) {
  const FullConfig& config = engine->config;
  const Lens& lens = engine->lens;
  starfocus_status status = FindMixedPixels(stripe, engine);
  if (status == STARFOCUS_OK) status = PlanStripe(stripe, engine);
  if (status == STARFOCUS_OK && IsBlockMode(lens) && !engine->input.has_layers) {
    PlaceLayers(stripe, lens.borders, engine);
    status = FillLayers(kAllLayers, nullptr, engine);
  }
  if (status == STARFOCUS_OK && IsBlockMode(lens)) status = FillPassLayers(stripe, engine);
  if (status != STARFOCUS_OK) return status;
  const StripePlan& plan = engine->stripe.plan;
  // Blocks with the largest predicted time come first, so that no worker starts a long block when
  // the other workers are already idle.
  std::sort(plan.blocks, plan.blocks + plan.used,
            [](const Block& a, const Block& b) { return a.cost > b.cost; });
  if (plan.used > 0) {
    status = ForEach(plan.used, engine->jobs, [&](int32_t index, int32_t worker) {
      const Block& block = plan.blocks[index];
      Scratch& scratch = engine->scratch[worker];
      // Counts the samples that every block reads and filters. Renderers count the samples of
      // rendered views separately.
      if (!scratch.cancel.Spend(3 * int64_t{block.rect.width} * block.rect.height)) return;
      RefocusBlock(*engine, block, out, &scratch);
    });
  }
  if (status != STARFOCUS_OK || !IsDeblocking(config, lens)) return status;
  return Deblock(stripe, out, engine);
}

}  // namespace

int32_t FinishedRows(const FullConfig& config, int32_t y) {
  const int32_t end = y + config.superblock;
  return end >= config.height ? config.height : end - kDeblockRows;
}

PictureRows BufferRows(const EngineState& engine, int32_t y) {
  PictureRows rows = engine.stripe.out;
  rows.codes.first = rows.deep.first = rows.alpha.first = y - kDeblockRows;
  return rows;
}

namespace {

// Copies the last kDeblockRows rows of a stripe to the row `to_row` of `to`, from row `from_row`.
void CopyLastRows(const PictureRows& from, int32_t from_row, const PictureRows& to,
                  int32_t to_row) {
  const auto copy = [&](const auto& source, const auto& target) {
    if (source.data == nullptr) return;
    std::memcpy(target.Row(to_row), source.Row(from_row),
                kDeblockRows * source.stride * sizeof(*source.data));
  };
  copy(from.codes, to.codes);
  copy(from.deep, to.deep);
  copy(from.alpha, to.alpha);
}

}  // namespace

starfocus_status RefocusStripe(EngineState* engine, int32_t y) {
  const RedZones zones(*engine);
  const FullConfig& config = engine->config;
  const Range stripe = {y, Min(y + config.superblock, config.height)};
  const PictureRows rows = BufferRows(*engine, y);
  const int32_t ends = y + config.superblock - kDeblockRows;
  const PictureRows& saved = engine->stripe.last_rows;
  const bool saves = saved.codes.data != nullptr || saved.is_deep();
  // Deblocking may change the last rows of the previous stripe. A retry after a failure starts from
  // the saved rows.
  CopyLastRows(saves ? saved : rows, saves ? 0 : ends, rows, y - kDeblockRows);
  const FullReport report = engine->report;
  if (!ChooseColumns(stripe, engine)) {
    // No block of the current stripe is refocused, so the next stripe deblocks no boundary with the
    // current stripe.
    ForgetStripe(&engine->stripe);
    return STARFOCUS_OK;
  }
  const starfocus_status status = RefocusPhases(stripe, rows, engine);
  if (status != STARFOCUS_OK) {
    // Restores the state that the engine had before the stripe. A retry recomputes the data that
    // the failed stripe shares with the previous stripe.
    engine->report = report;
    DropCounts(engine);
    engine->stripe.plan.all_measured = false;
    ForgetLayers(config, &engine->layers);
    return status;
  }
  ReportCounts(engine);
  // The next stripe deblocks its boundary with the last blocks of this stripe.
  const LayerMap& map = engine->stripe.map;
  std::memcpy(map.layers, &map.At(0, map.rows - 1), static_cast<size_t>(map.columns));
  if (saves) CopyLastRows(rows, ends, saved, 0);
  return STARFOCUS_OK;
}

}  // namespace starfocus
