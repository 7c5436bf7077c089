// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/stripe.h"

#include <algorithm>
#include <cstring>

#include "lib/engine/layout.h"
#include "lib/engine/stripe_coverage.h"
#include "lib/engine/stripe_layers.h"
#include "lib/engine/stripe_plan.h"

namespace starfocus {
namespace {

// Refocuses the blocks of a stripe. Job `index` refocuses block `index`.
struct RefocusJob {
  BlockInputs in;
  const Block* blocks;
  Plane<uint8_t> out;  // output: rows of the refocused picture
};

void RefocusOneBlock(const RefocusJob& job, int32_t index, Scratch* scratch) {
  const Block& block = job.blocks[index];
  // Counts the samples that every block reads and filters. Renderers count the samples of rendered
  // views separately.
  if (!scratch->cancel.Spend(3 * int64_t{block.rect.width} * block.rect.height)) return;
  RefocusBlock(job.in, block, job.out, scratch);
}

// Deblocks the boundaries between blocks of different layers. For boundaries between rows, job
// `index` processes column `index` of superblocks. For boundaries between columns, job `index`
// processes kSmallestBlock finished rows.
struct JoinJob {
  DeblockJob deblock;
  int32_t smallest;  // number of smallest blocks along the side of a superblock
  RowRange finished;
};

void DeblockRowBoundaries(const JoinJob& job, int32_t column, Scratch*) {
  DeblockRows(job.deblock, column * job.smallest,
              Min((column + 1) * job.smallest, job.deblock.map->columns));
}

void DeblockColumnBoundaries(const JoinJob& job, int32_t index, Scratch*) {
  const int32_t first = job.finished.first + index * kSmallestBlock;
  DeblockColumns(job.deblock, first, Min(first + kSmallestBlock, job.finished.last));
}

starfocus_status Deblock(const Stripe& stripe, const Plane<uint8_t>& out, EngineState* engine) {
  const starfocus_config& config = engine->config;
  const Transfer* transfer = engine->row_store.windows[0].transfer;
  const JoinJob job = {{&engine->stripe.map, out, config.width, config.height, stripe.y,
                        config.tuning.deblocking, transfer, engine->kernels},
                       config.superblock / kSmallestBlock,
                       {Max(0, stripe.y - kDeblockRows), FinishedRows(config, stripe.y)}};
  const starfocus_status status =
      RunJobs<JoinJob, DeblockRowBoundaries>(job, Columns(config), &engine->workers);
  const int32_t rows = job.finished.last - job.finished.first;
  if (status != STARFOCUS_OK || rows <= 0) return status;
  return RunJobs<JoinJob, DeblockColumnBoundaries>(
      job, (rows + kSmallestBlock - 1) / kSmallestBlock, &engine->workers);
}

starfocus_status RefocusPhases(const Stripe& stripe, const Plane<uint8_t>& out,
                               EngineState* engine) {
  const starfocus_config& config = engine->config;
  const Lens& lens = engine->lens;
  starfocus_status status = FindCoverage(stripe, engine);
  if (status == STARFOCUS_OK) status = PlanStripe(stripe, engine);
  if (status == STARFOCUS_OK && IsBlockMode(lens) && !engine->row_store.prepared) {
    PlaceLayers({stripe.y, stripe.y + stripe.height}, lens.borders, &engine->row_store);
    status = FillLayers(config, *engine->kernels, kAllLayers, &engine->workers, &engine->row_store);
  }
  if (status != STARFOCUS_OK) return status;
  const StripePlan& plan = engine->stripe.plan;
  // Blocks with the largest predicted time come first, so that no worker starts a long block when
  // the other workers are already idle.
  std::sort(plan.blocks, plan.blocks + plan.used,
            [](const Block& a, const Block& b) { return a.cost > b.cost; });
  const RefocusJob job = {InputsOf(*engine), plan.blocks, out};
  if (plan.used > 0) {
    status = RunJobs<RefocusJob, RefocusOneBlock>(job, plan.used, &engine->workers);
  }
  if (status != STARFOCUS_OK || !IsDeblocking(config, lens)) return status;
  return Deblock(stripe, out, engine);
}

// Keeps the state of a finished stripe that the next stripe reuses.
void KeepStripe(EngineState* engine) {
  TakeCounts(engine);
  const LayerMap& map = engine->stripe.map;
  std::memcpy(map.layers, &map.At(0, map.rows - 1), static_cast<size_t>(map.columns));
}

// Restores the state that the engine had before a stripe failed. A retry recomputes the data that
// the failed stripe shares with the previous stripe.
void WithdrawStripe(const starfocus_report& report, EngineState* engine) {
  engine->report = report;
  DropCounts(engine);
  engine->stripe.plan.all_measured = false;
  ForgetLayers(engine->config, &engine->row_store);
}

}  // namespace

BlockInputs InputsOf(const EngineState& engine) {
  return {&engine.config,
          engine.kernels,
          &engine.tables,
          &engine.lens,
          engine.row_store.windows,
          &engine.stripe.cells,
          &engine.stripe.plan.gathered,
          engine.clock};
}

int32_t FinishedRows(const starfocus_config& config, int32_t y) {
  const int32_t end = y + config.superblock;
  return end >= config.height ? config.height : end - kDeblockRows;
}

Plane<uint8_t> BufferRows(const EngineState& engine, int32_t y) {
  return {engine.stripe.out, 3 * static_cast<size_t>(engine.config.width), 0, y - kDeblockRows};
}

starfocus_status RefocusStripe(EngineState* engine, int32_t y) {
  const RedZones zones(engine);
  const starfocus_config& config = engine->config;
  const Stripe stripe = {y, Min(config.superblock, config.height - y)};
  const Plane<uint8_t> rows = BufferRows(*engine, y);
  uint8_t* const ends = rows.Row(y + config.superblock - kDeblockRows);
  uint8_t* const last_rows = engine->stripe.last_rows;
  const size_t bytes = kDeblockRows * rows.stride;
  // Deblocking may change the last rows of the previous stripe. A retry after a failure starts from
  // the saved rows.
  std::memcpy(rows.Row(y - kDeblockRows), last_rows != nullptr ? last_rows : ends, bytes);
  const starfocus_report report = engine->report;
  if (!ChooseColumns(stripe, engine)) {
    // No block of the current stripe is refocused, so the next stripe deblocks no boundary with the
    // current stripe.
    ForgetStripe(&engine->stripe);
    return STARFOCUS_OK;
  }
  const starfocus_status status = RefocusPhases(stripe, rows, engine);
  if (status != STARFOCUS_OK) {
    WithdrawStripe(report, engine);
    return status;
  }
  KeepStripe(engine);
  if (last_rows != nullptr) std::memcpy(last_rows, ends, bytes);
  return STARFOCUS_OK;
}

}  // namespace starfocus
