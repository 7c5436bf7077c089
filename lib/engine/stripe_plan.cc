// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/stripe_plan.h"

#include <cstring>

#include "lib/engine/stripe_layers.h"
#include "lib/io/excess.h"

namespace starfocus {
namespace {

// Measures the cells of columns of superblocks. Job `index` processes column `index`.
struct MeasureJob {
  const simd::Kernels* kernels;
  const Window* window;  // layer 0
  BlurScale scale;
  int32_t per_block;  // Number of columns of cells in a superblock.
  int32_t first_row;  // First row of cells that no earlier stripe has measured.
  const uint8_t* measured;
  CellGrid cells;  // output: measured cells
};

// Splits superblocks into blocks. Job `index` processes column `index`.
struct PlanJob {
  const starfocus_config* config;
  const simd::Kernels* kernels;
  const ApertureShape* opening;
  const Lens* lens;
  const CellGrid* cells;
  const Window* window;  // layer 0
  Stripe rows;
  StripePlan plan;  // output: blocks, counts and gathered cells
};

// Returns true if the blur in the picture decides how superblocks are split into blocks.
bool IsPartitioned(const Lens& lens) { return IsBlockMode(lens) && !IsPinhole(lens); }

// Returns the largest side of a block. A block uses one cat's eye, computed for the middle of the
// block. Blocks with cat's eyes are small, because the exact cat's eye varies within a block.
int32_t LargestSide(const PlanJob& job) {
  constexpr int32_t kCatsEyeSide = 32;
  const int32_t largest = job.opening->cats_eye > 0 ? kCatsEyeSide : job.plan.side;
  return IsBenchmark(*job.lens) ? Min(largest, job.lens->renderer->benchmark_side) : largest;
}

// Returns true if blocks in `rect` may show light of highlights beyond white: some view has a
// highlight within the reach of blur and disparity. Returns false if a single highlight larger than
// a lamp covers the whole area within reach.
bool HasHighlights(const PlanJob& job, const Rect& rect) {
  const starfocus_config& config = *job.config;
  if (!(config.highlights > 1)) return false;
  const int32_t around = job.lens->borders.highlights;
  const Rect near = Extended(rect, {around, around, around, around});
  if (!MayHaveHighlights(*job.window, near)) return false;
  const int32_t lamp = LampReach(LargestLamp(config.width));
  return !AreAllHighlights(*job.window, Extended(near, {lamp, lamp, lamp, lamp}));
}

Block WholeBlock(const PlanJob& job, const Rect& rect) {
  const Lens& lens = *job.lens;
  const int32_t border = lens.borders.whole_block;
  Block block;
  block.rect = block.rendered = rect;
  block.border = {border, border, border, border};
  block.layer = 0;
  block.n = lens.aperture.n;
  block.gathers = block.has_highlights = false;
  block.cost =
      PredictTime(job.config->tuning.timing,
                  lens.renderer->measure_work(block.rendered, block.border, lens.aperture, {}, 0));
  return block;
}

// Plans blocks of one size at layer 0, for the frame modes, blur mode and pinholes.
void PlanWhole(const PlanJob& job, int32_t column) {
  const Lens& lens = *job.lens;
  const int32_t largest = job.plan.side;
  const int32_t side = LargestSide(job);
  const int32_t left = column * largest, right = Min(left + largest, job.config->width);
  const int32_t bottom = job.rows.y + job.rows.height;
  const bool has_highlights =
      !IsPinhole(lens) && HasHighlights(job, {left, job.rows.y, right - left, job.rows.height});
  int32_t count = 0;
  for (int32_t y = job.rows.y; y < bottom; y += side) {
    for (int32_t x = left; x < right; x += side) {
      Block& block = job.plan.BlocksOf(column)[count++];
      block = WholeBlock(job, {x, y, Min(side, right - x), Min(side, bottom - y)});
      block.has_highlights = has_highlights;
    }
  }
  job.plan.counts[column] = count;
}

void PlanBlocks(const PlanJob& job, int32_t column, Scratch* scratch) {
  const StripePlan& plan = job.plan;
  const Lens& lens = *job.lens;
  plan.counts[column] = 0;
  if (plan.wanted[column] == 0) return;
  if (!IsPartitioned(lens)) {
    PlanWhole(job, column);
    return;
  }
  const int32_t left = column * plan.side;
  const bool has_highlights = HasHighlights(
      job, {left, job.rows.y, Min(plan.side, job.config->width - left), job.rows.height});
  // Blocks with highlights are rendered from views at layer 0, because light beyond white is read
  // only at layer 0.
  const PartitionRules rules = {job.config,
                                lens.renderer,
                                lens.apertures,
                                lens.largest_n,
                                DemandOf(*job.opening),
                                lens.scale,
                                LargestSide(job),
                                has_highlights ? 0 : job.config->tuning.max_layer,
                                !has_highlights && Gathers(*job.config, lens),
                                has_highlights};
  const PlanInput input = {*job.kernels, rules, *job.cells, lens.borders.cells};
  plan.counts[column] = PartitionBlock(input, left, job.rows.y, scratch->partition,
                                       plan.BlocksOf(column), plan.gathered);
}

void MeasureColumn(const MeasureJob& job, int32_t index, Scratch*) {
  if (job.measured[index] == 0) return;
  const int32_t first = index * job.per_block;
  const int32_t last = Min(first + job.per_block, job.cells.columns);
  for (int32_t row = job.first_row; row < job.cells.last_row; ++row) {
    MeasureCells(*job.kernels, *job.window, job.scale,
                 {row, first, last, job.cells.At(first, row)});
  }
}

// Returns true if the region that the lens requests depends on pixels of `rect`.
bool IsInRegion(const EngineState& engine, const Rect& rect) {
  const Rect& region = engine.lens.region;
  const int32_t reach = engine.lens.borders.joined;
  return rect.x - reach < region.x + region.width && region.x < rect.x + rect.width + reach &&
         rect.y - reach < region.y + region.height && region.y < rect.y + rect.height + reach;
}

// Returns true if pixels of `rect` affect pixels that are not copied from the previous picture.
// Deblocking changes pixels within its reach of a changed pixel, and reads pixels within its reach
// of every pixel that it changes. The test therefore extends `rect` by twice the reach of
// deblocking.
bool IsNew(const EngineState& engine, const Rect& rect) {
  const int32_t reach = 2 * engine.lens.borders.joined;
  const FrameDiff& changes = engine.stripe.changes;
  return !changes.active || HasChanged(changes, {rect.x - reach, rect.y - reach,
                                                 rect.width + 2 * reach, rect.height + 2 * reach});
}

// Moves the grid of cells to the stripe and its surroundings. Returns the first row of cells to
// measure; the cells above this row were measured for the previous stripe.
int32_t PlaceCells(const Stripe& stripe, const Lens& lens, StripeState* state) {
  CellGrid& cells = state->cells;
  StripePlan& plan = state->plan;
  const int32_t first = Max(0, stripe.y / kCellSize - lens.borders.cells);
  const int32_t last = (stripe.y + stripe.height - 1) / kCellSize;
  const bool all = std::memchr(plan.measured, 0, static_cast<size_t>(plan.columns)) == nullptr;
  int32_t known = first;
  if (plan.all_measured && all && cells.last_row > first) {
    known = cells.last_row;
    std::memmove(
        cells.cells, cells.At(0, first),
        static_cast<size_t>(known - first) * static_cast<size_t>(cells.columns) * sizeof(Cell));
  }
  plan.all_measured = all;
  cells.first_row = first;
  cells.last_row = Min(cells.rows, last + lens.borders.cells + 1);
  return known;
}

void MapBlock(const Stripe& stripe, const Block& block, const LayerMap& map) {
  const Rect& rect = block.rect;
  for (int32_t y = rect.y; y < rect.y + rect.height; y += kSmallestBlock) {
    for (int32_t x = rect.x; x < rect.x + rect.width; x += kSmallestBlock) {
      map.At(x / kSmallestBlock, (y - stripe.y) / kSmallestBlock) =
          static_cast<uint8_t>(block.layer);
    }
  }
}

// Sets all smallest blocks of the map to kNoLayer, which remains where no block covers the map.
void ClearMap(const Stripe& stripe, LayerMap* map) {
  map->rows = (stripe.height + kSmallestBlock - 1) / kSmallestBlock;
  std::memset(&map->At(0, 0), kNoLayer,
              static_cast<size_t>(map->columns) * static_cast<size_t>(map->rows));
}

// Adds a block to the report and passes the block to the caller's visitor.
void ReportBlock(const Block& block, EngineState* engine) {
  starfocus_report& report = engine->report;
  if (block.n > report.n || report.rendered_views == 0) {
    report.n = block.n;
    report.rendered_views = WeightsOf(engine->lens, block.n).views;
  }
  if (engine->on_block == nullptr) return;
  const starfocus_block told = {block.rect.x,      block.rect.y, block.rect.width,
                                block.rect.height, block.layer,  block.n};
  engine->on_block(engine->on_block_data, &told);
}

// Keeps the blocks that affect the requested pixels, and derives the inputs of the later phases
// from these blocks.
void ReadPlan(const Stripe& stripe, EngineState* engine) {
  const starfocus_config& config = engine->config;
  RowStore& row_store = engine->row_store;
  StripePlan& plan = engine->stripe.plan;
  plan.used = 0;
  ClearMap(stripe, &engine->stripe.map);
  ClearLayerColumns(config, &row_store);
  for (int32_t column = 0; column < plan.columns; ++column) {
    const Block* const planned = plan.BlocksOf(column);
    for (int32_t k = 0; k < plan.counts[column]; ++k) {
      if (!IsInRegion(*engine, planned[k].rect) || !IsNew(*engine, planned[k].rect)) continue;
      const Block& block = plan.blocks[plan.used++] = planned[k];
      MarkLayerColumns(config, block, &row_store);
      MapBlock(stripe, block, engine->stripe.map);
      ReportBlock(block, engine);
    }
  }
}

}  // namespace

bool ChooseColumns(const Stripe& rows, EngineState* engine) {
  const StripePlan& plan = engine->stripe.plan;
  const int32_t side = plan.side;
  std::memset(plan.measured, 0, static_cast<size_t>(plan.columns));
  bool any = false;
  for (int32_t column = 0; column < plan.columns; ++column) {
    const Rect block = {column * side, rows.y, side, rows.height};
    const bool inside = IsInRegion(*engine, block), wanted = inside && IsNew(*engine, block);
    plan.wanted[column] = wanted ? 1 : 0;
    if (inside && !wanted) ++engine->report.reused_blocks;
    if (!wanted) continue;
    any = true;
    const int32_t around = engine->lens.borders.cells * kCellSize;
    const int32_t first = Max(0, column * side - around) / side;
    const int32_t last = Min(plan.columns, ((column + 1) * side + around - 1) / side + 1);
    std::memset(plan.measured + first, 1, static_cast<size_t>(last - first));
  }
  return any;
}

starfocus_status PlanStripe(const Stripe& rows, EngineState* engine) {
  const Lens& lens = engine->lens;
  StripeState& state = engine->stripe;
  const int32_t columns = state.plan.columns;
  if (IsPartitioned(lens)) {
    state.plan.gathered.first_row = rows.y / kCellSize;
    const int32_t first_row = PlaceCells(rows, lens, &state);
    const MeasureJob job = {
        engine->kernels, &engine->row_store.windows[0], lens.scale, state.plan.side / kCellSize,
        first_row,       state.plan.measured,           state.cells};
    const starfocus_status status =
        RunJobs<MeasureJob, MeasureColumn>(job, columns, &engine->workers);
    if (status != STARFOCUS_OK) return status;
  }
  const PlanJob job = {&engine->config,
                       engine->kernels,
                       &engine->tables.opening,
                       &lens,
                       &state.cells,
                       &engine->row_store.windows[0],
                       rows,
                       state.plan};
  const starfocus_status status = RunJobs<PlanJob, PlanBlocks>(job, columns, &engine->workers);
  if (status != STARFOCUS_OK) return status;
  ReadPlan(rows, engine);
  return STARFOCUS_OK;
}

}  // namespace starfocus
