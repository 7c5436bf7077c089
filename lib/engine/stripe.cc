#include "lib/engine/stripe.h"

#include <cstring>

#include "lib/engine/refocus_block.h"
#include "lib/engine/stripe_layers.h"

namespace starfocus {
namespace {

// One stripe, for the jobs of its phases.
struct Stripe {
  EngineState* engine;
  int32_t y, height;  // rows of the picture
  Plane<uint8_t> out;
  int32_t first_row;  // of the rows that deblocking finishes
  int32_t last_row;
  int32_t first_cells;  // row of the first cells that no stripe before it has measured
};

Block* BlocksOf(const EngineState& engine, int32_t column) {
  return engine.plan.blocks + static_cast<size_t>(column) * MaxBlocks(BlockSide(engine));
}

// Fine slices of small blocks are fewer, and fit the memory that coarser ones have.
constexpr int32_t kFineSide = 32;

Block WholeBlock(const EngineState& engine, const Rect& rect) {
  const int32_t border = engine.reach.border - kCellSize;
  Block block;
  block.rect = block.rendered = rect;
  block.border = {border, border, border, border};
  block.layer = 0;
  block.n = engine.aperture.n;
  block.gathers = false;
  const ViewCounts views =
      UsesSubapertures(engine) ? CountSubapertures(engine.aperture) : CountViews(engine.aperture.n);
  block.cost = PredictTime(engine.config.timing, MeasureWork(block.rendered, block.border, views,
                                                             UsesSubapertures(engine), 0, {}, 0));
  return block;
}

// Frame modes and blur: blocks of one size, at layer 0.
void PlanWhole(const Stripe& stripe, int32_t column) {
  EngineState& engine = *stripe.engine;
  const int32_t largest = BlockSide(engine);
  const int32_t side = IsBenchmark(engine) && UsesSubapertures(engine) ? kFineSide : largest;
  const int32_t left = column * largest, right = Min(left + largest, engine.config.width);
  const int32_t bottom = stripe.y + stripe.height;
  int32_t count = 0;
  for (int32_t y = stripe.y; y < bottom; y += side) {
    for (int32_t x = left; x < right; x += side) {
      BlocksOf(engine, column)[count++] =
          WholeBlock(engine, {x, y, Min(side, right - x), Min(side, bottom - y)});
    }
  }
  engine.plan.counts[column] = count;
}

// Whether the region depends on pixels of `rect`.
bool IsInRegion(const EngineState& engine, const Rect& rect) {
  const Rect& region = engine.region;
  const int32_t reach = JoinReach(engine);
  return rect.x - reach < region.x + region.width && region.x < rect.x + rect.width + reach &&
         rect.y - reach < region.y + region.height && region.y < rect.y + rect.height + reach;
}

// Whether pixels that are not copied from the picture before depend on pixels of `rect`. Those are
// what has changed and as far around it as joins reach, and joins reach there from as far again.
bool IsNew(const EngineState& engine, const Rect& rect) {
  const int32_t reach = 2 * JoinReach(engine);
  return !engine.changes.active ||
         HasChanged(engine.changes, {rect.x - reach, rect.y - reach, rect.width + 2 * reach,
                                     rect.height + 2 * reach});
}

// Marks the columns that the stripe refocuses and those whose cells they need; whether there are
// any.
bool ChooseColumns(const Stripe& stripe) {
  EngineState& engine = *stripe.engine;
  const int32_t side = BlockSide(engine), columns = Columns(engine);
  std::memset(engine.plan.measured, 0, static_cast<size_t>(columns));
  bool any = false;
  for (int32_t column = 0; column < columns; ++column) {
    const Rect block = {column * side, stripe.y, side, stripe.height};
    const bool inside = IsInRegion(engine, block), wanted = inside && IsNew(engine, block);
    engine.plan.wanted[column] = wanted ? 1 : 0;
    if (inside && !wanted) ++engine.report.reused_blocks;
    if (!wanted) continue;
    any = true;
    const int32_t around = engine.reach.cells * kCellSize;
    const int32_t first = Max(0, column * side - around) / side;
    const int32_t last = Min(columns, ((column + 1) * side + around - 1) / side + 1);
    std::memset(engine.plan.measured + first, 1, static_cast<size_t>(last - first));
  }
  return any;
}

void MeasureColumn(const Stripe& stripe, int32_t index, Worker*) {
  EngineState& engine = *stripe.engine;
  if (engine.plan.measured[index] == 0) return;
  const int32_t per_block = BlockSide(engine) / kCellSize, first = index * per_block;
  const int32_t last = Min(first + per_block, engine.cells.columns);
  for (int32_t row = stripe.first_cells; row < engine.cells.last_row; ++row) {
    MeasureCells(*engine.kernels, engine.windows[0], engine.scale, row, first, last,
                 engine.cells.At(first, row));
  }
}

void PlanBlocks(const Stripe& stripe, int32_t column, Worker* worker) {
  EngineState& engine = *stripe.engine;
  engine.plan.counts[column] = 0;
  if (engine.plan.wanted[column] == 0) return;
  if (!IsBlockMode(engine)) {
    PlanWhole(stripe, column);
    return;
  }
  PartitionRules rules;
  rules.width = engine.config.width;
  rules.height = engine.config.height;
  rules.largest_block = BlockSide(engine);
  rules.max_layer = engine.config.max_layer;
  rules.max_n = UsesSubapertures(engine) ? engine.max_subaperture_n : engine.max_n;
  rules.subapertures = UsesSubapertures(engine);
  rules.n_scale = engine.config.n_scale;
  rules.gathers = UsesSubapertures(engine) && engine.config.gather != 0;
  rules.scale = engine.scale;
  rules.timing = engine.config.timing;
  rules.views = UsesSubapertures(engine) ? engine.subaperture_view_counts : engine.view_counts;
  engine.plan.counts[column] = PartitionBlock(
      *engine.kernels, rules, engine.cells, column * BlockSide(engine), stripe.y,
      engine.reach.cells, worker->partition, BlocksOf(engine, column), engine.plan.gathered);
}

void MapBlock(const EngineState& engine, const Stripe& stripe, const Block& block) {
  const Rect& rect = block.rect;
  for (int32_t y = rect.y; y < rect.y + rect.height; y += kSmallestBlock) {
    for (int32_t x = rect.x; x < rect.x + rect.width; x += kSmallestBlock) {
      engine.map.At(x / kSmallestBlock, (y - stripe.y) / kSmallestBlock) =
          static_cast<uint8_t>(block.layer);
    }
  }
}

// Units of the map that no block covers stay without a layer.
void ClearMap(const Stripe& stripe) {
  LayerMap& map = stripe.engine->map;
  map.rows = (stripe.height + kSmallestBlock - 1) / kSmallestBlock;
  std::memset(&map.At(0, 0), kNoLayer,
              static_cast<size_t>(map.columns) * static_cast<size_t>(map.rows));
}

// Counts a block that will be refocused; tells the caller of it.
void Announce(const Block& block, EngineState* engine) {
  sf_report& report = engine->report;
  if (block.n > report.n || report.rendered_views == 0) {
    report.n = block.n;
    report.rendered_views = ApertureOf(*engine, block.n).views;
  }
  if (engine->params.on_block == nullptr) return;
  const sf_block told = {block.rect.x,      block.rect.y, block.rect.width,
                         block.rect.height, block.layer,  block.n};
  engine->params.on_block(engine->params.on_block_data, &told);
}

// What the plan means for the other phases; leaves out blocks that nothing asked for depends on.
void ReadPlan(const Stripe& stripe) {
  EngineState& engine = *stripe.engine;
  ClearMap(stripe);
  ClearLayerColumns(engine);
  if (engine.config.skips == 0) MarkLayerColumns(engine);
  for (int32_t column = 0; column < Columns(engine); ++column) {
    Block* const blocks = BlocksOf(engine, column);
    int32_t kept = 0;
    for (int32_t k = 0; k < engine.plan.counts[column]; ++k) {
      if (!IsInRegion(engine, blocks[k].rect) || !IsNew(engine, blocks[k].rect)) continue;
      const Block& block = blocks[kept++] = blocks[k];
      MarkLayerColumns(engine, block);
      MapBlock(engine, stripe, block);
      Announce(block, &engine);
    }
    engine.plan.counts[column] = kept;
  }
}

void RefocusColumn(const Stripe& stripe, int32_t column, Worker* worker) {
  const EngineState& engine = *stripe.engine;
  for (int32_t k = 0; k < engine.plan.counts[column]; ++k) {
    RefocusBlock(engine, BlocksOf(engine, column)[k], stripe.out, worker);
  }
}

DeblockJob MakeDeblockJob(const Stripe& stripe) {
  const sf_config& config = stripe.engine->config;
  return {&stripe.engine->map, stripe.out, config.width,
          config.height,       stripe.y,   config.deblocking};
}

void DeblockRowBoundaries(const Stripe& stripe, int32_t column, Worker*) {
  const int32_t units = BlockSide(*stripe.engine) / kSmallestBlock;
  DeblockRows(MakeDeblockJob(stripe), column * units,
              Min((column + 1) * units, stripe.engine->map.columns));
}

void DeblockColumnBoundaries(const Stripe& stripe, int32_t index, Worker*) {
  const int32_t first = stripe.first_row + index * kSmallestBlock;
  DeblockColumns(MakeDeblockJob(stripe), first, Min(first + kSmallestBlock, stripe.last_row));
}

// Makes room for the cells around the stripe; returns the first row that has to be measured. Those
// above it are the stripe's before.
int32_t PlaceCells(int32_t y, int32_t height, EngineState* engine) {
  CellGrid& cells = engine->cells;
  const int32_t first = Max(0, y / kCellSize - engine->reach.cells);
  const int32_t last = (y + height - 1) / kCellSize;
  const bool all =
      std::memchr(engine->plan.measured, 0, static_cast<size_t>(Columns(*engine))) == nullptr;
  int32_t known = first;
  if (engine->plan.all_measured && all && cells.last_row > first) {
    known = cells.last_row;
    std::memmove(
        cells.cells, cells.At(0, first),
        static_cast<size_t>(known - first) * static_cast<size_t>(cells.columns) * sizeof(Cell));
  }
  engine->plan.all_measured = all;
  cells.first_row = first;
  // A smallest block may hang over the picture's last row of cells.
  cells.last_row = Min(cells.rows, last + engine->reach.cells + 2);
  return known;
}

sf_status PlanStripe(Stripe* stripe, const Runner& runner) {
  EngineState& engine = *stripe->engine;
  const int32_t columns = Columns(engine);
  sf_status status = SF_OK;
  if (IsBlockMode(engine)) {
    engine.plan.gathered.first_row = stripe->y / kCellSize;
    stripe->first_cells = PlaceCells(stripe->y, stripe->height, &engine);
    status = RunJobs<Stripe, MeasureColumn>(*stripe, columns, runner);
    if (status != SF_OK) return status;
  }
  status = RunJobs<Stripe, PlanBlocks>(*stripe, columns, runner);
  if (status == SF_OK) ReadPlan(*stripe);
  return status;
}

// Counts the columns of layers that no block needs.
void CountSpared(EngineState* engine) {
  const int32_t columns = Columns(*engine);
  for (int layer = 1; layer <= engine->config.max_layer; ++layer) {
    for (int32_t column = 0; column < columns; ++column) {
      engine->report.skipped.layer_columns += (engine->plan.needed[layer][column] & kNeeded) == 0;
    }
  }
}

sf_status Deblock(Stripe* stripe, const Runner& runner) {
  EngineState& engine = *stripe->engine;
  const LayerMap& map = engine.map;
  if (engine.config.skips != 0 && map.IsUniform(stripe->y > 0)) {
    const int32_t inside = map.rows * (map.columns - 1) + (map.rows - 1) * map.columns;
    engine.report.skipped.boundaries +=
        static_cast<uint64_t>(inside + (stripe->y > 0 ? map.columns : 0));
    return SF_OK;
  }
  const sf_status status = RunJobs<Stripe, DeblockRowBoundaries>(*stripe, Columns(engine), runner);
  const int32_t rows = stripe->last_row - stripe->first_row;
  if (status != SF_OK || rows <= 0) return status;
  return RunJobs<Stripe, DeblockColumnBoundaries>(
      *stripe, (rows + kSmallestBlock - 1) / kSmallestBlock, runner);
}

sf_status RefocusPhases(Stripe* stripe, const Runner& runner) {
  EngineState& engine = *stripe->engine;
  sf_status status = PlanStripe(stripe, runner);
  if (status == SF_OK && IsBlockMode(engine)) CountSpared(&engine);
  if (status == SF_OK && IsBlockMode(engine) && !engine.prepared) {
    const int32_t around = (engine.reach.cells + 1) * kCellSize;
    PlaceLayers({stripe->y - around, stripe->y + stripe->height + around}, &engine);
    status = FillLayers(&engine, runner);
  }
  if (status == SF_OK) status = RunJobs<Stripe, RefocusColumn>(*stripe, Columns(engine), runner);
  if (status == SF_OK && IsDeblocking(engine)) status = Deblock(stripe, runner);
  return status;
}

// What the next stripe takes over from this one.
void KeepStripe(EngineState* engine) {
  TakeCounts(engine);
  LayerMap& map = engine->map;
  std::memcpy(map.units, &map.At(0, map.rows - 1), static_cast<size_t>(map.columns));
}

// As if the stripe had not been begun; what it shared with the one before is made again.
void WithdrawStripe(const sf_report& report, EngineState* engine) {
  engine->report = report;
  DropCounts(engine);
  engine->plan.all_measured = false;
  ForgetLayers(engine);
}

}  // namespace

int32_t FinishedRows(const EngineState& engine, int32_t y) {
  const int32_t end = y + BlockSide(engine);
  return end >= engine.config.height ? engine.config.height : end - kDeblockRows;
}

sf_status RefocusStripe(EngineState* engine, int32_t y, const Plane<uint8_t>& out,
                        const Runner& runner) {
  Stripe stripe = {engine,
                   y,
                   Min(BlockSide(*engine), engine->config.height - y),
                   out,
                   Max(0, y - kDeblockRows),
                   FinishedRows(*engine, y),
                   0};
  const sf_report report = engine->report;
  if (!ChooseColumns(stripe)) {
    ForgetStripe(engine);  // nothing for the next stripe to join
    return SF_OK;
  }
  const sf_status status = RefocusPhases(&stripe, runner);
  if (status == SF_OK) {
    KeepStripe(engine);
  } else {
    WithdrawStripe(report, engine);
  }
  return status;
}

Plane<uint8_t> BufferRows(const EngineState& engine, int32_t y) {
  return {engine.stripe_out, 3 * static_cast<size_t>(engine.config.width), 0, y - kDeblockRows};
}

sf_status RefocusIntoBuffer(EngineState* engine, int32_t y, const Runner& runner) {
  const Plane<uint8_t> rows = BufferRows(*engine, y);
  const size_t bytes = kDeblockRows * rows.stride;
  // The last rows of the stripe before may still change, and anew when a stripe that failed is
  // refocused again.
  std::memcpy(rows.Row(y - kDeblockRows), engine->last_rows, bytes);
  const sf_status status = RefocusStripe(engine, y, rows, runner);
  if (status == SF_OK) {
    std::memcpy(engine->last_rows, rows.Row(y + BlockSide(*engine) - kDeblockRows), bytes);
  }
  return status;
}

}  // namespace starfocus
