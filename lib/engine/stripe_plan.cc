// SPDX-License-Identifier: Apache-2.0
// Plans a stripe: selects the superblocks to refocus, measures their cells, and splits each
// superblock into blocks.
#include <cstring>

#include "lib/engine/stripe.h"
#include "lib/io/deep.h"
#include "lib/io/highlights.h"
#include "simd/words.h"

namespace starfocus {
namespace {

// Returns true if the blur in the picture decides how superblocks are split into blocks.
bool IsPartitioned(const Lens& lens) { return IsBlockMode(lens) && !IsPinhole(lens); }

// Returns the largest side of a block. A block uses one cat's eye, computed for the middle of the
// block. Blocks with cat's eyes are small, because the exact cat's eye varies within a block.
int32_t LargestSide(const EngineState& engine) {
  constexpr int32_t kCatsEyeSide = 32;
  const Lens& lens = engine.lens;
  const int32_t largest =
      engine.tables->opening.cats_eye > 0 ? kCatsEyeSide : engine.stripe.plan.side;
  return IsBenchmark(lens) ? Min(largest, lens.renderer->benchmark_side) : largest;
}

// Returns the sum of the tiles whose pixels blocks in `rect` may show. Rows beyond the border of
// the stripe are not stored.
LightTile TilesAround(const EngineState& engine, const Rect& rect) {
  constexpr int32_t kColumns = LightTile::kTileColumns;
  const Borders& borders = engine.lens.borders;
  const int32_t reach = borders.highlights, down = Min(reach, borders.centre);
  const int32_t first = Max(0, rect.x - reach) / kColumns;
  const int32_t last = (Min(engine.config.width, rect.x + rect.width + reach) - 1) / kColumns;
  const int32_t bottom = Min(engine.config.height, rect.y + rect.height + down);
  LightTile sum = {0, 0};
  for (int32_t y = Max(0, rect.y - down); y < bottom; ++y) {
    for (int32_t tile = first; tile <= last; ++tile) sum.Add(engine.rings.tiles.Row(y)[tile]);
  }
  return sum;
}

// Sets the passes of blocks in `rect`.
void FindPasses(const EngineState& engine, const Rect& rect, Block* blocks, int32_t count) {
  bool excess = false, alpha = false;
  if (engine.input.is_deep()) {
    const LightTile tiles = TilesAround(engine, rect);
    excess = tiles.excess_bits != 0;
    alpha = tiles.transparent != 0;
  } else if (engine.config.highlights > 1) {
    excess = HasHighlights(engine.input, rect, engine.lens.borders.highlights);
  }
  for (int32_t k = 0; k < count; ++k) {
    blocks[k].passes[kLightPass] = true;
    blocks[k].passes[kExcessPass] = excess;
    blocks[k].passes[kAlphaPass] = alpha;
  }
}

// Finds the cells of a deep picture that show light beyond white where the blur radius varies,
// marks a depth edge there, and renders them at layer 0.
void MarkLamps(const EngineState& engine, int32_t row, const Range& columns) {
  const Plane<const uint16_t>& light = engine.input.deep_rows[0];
  for (int32_t column = columns.first; column < columns.last; ++column) {
    const Rect cell = {column * kCellSize, row * kCellSize, kCellSize, kCellSize};
    const Rect around =
        Clipped(Extended(cell, {kCellBorder, kCellBorder, kCellBorder, kCellBorder}),
                engine.config.width, engine.config.height);
    const auto is_lamp = [&](int32_t x, int32_t y) { return IsBeyondWhite(light.Row(y) + 3 * x); };
    if (!IsUneven(engine.input, engine.lens.scale, around) || !AnyPixel(around, is_lamp)) continue;
    Cell& marked = *engine.stripe.cells.At(column, row);
    marked.has_edge = 1;
    marked.r_shown = 0;
  }
}

// Plans blocks of one size at layer 0, for the frame modes, blur mode and pinholes. `superblock` is
// the part of the superblock inside the picture. Returns the number of blocks.
int32_t PlanWhole(const EngineState& engine, const Rect& superblock, Block* blocks) {
  const Lens& lens = engine.lens;
  const int32_t side = LargestSide(engine), border = lens.borders.whole_block;
  const int32_t right = superblock.x + superblock.width, bottom = superblock.y + superblock.height;
  Block block;
  block.border = {border, border, border, border};
  block.layer = 0;
  block.n = lens.frame_weights.n;
  block.gathers = false;
  int32_t count = 0;
  for (int32_t y = superblock.y; y < bottom; y += side) {
    for (int32_t x = superblock.x; x < right; x += side) {
      block.rect = block.rendered = {x, y, Min(side, right - x), Min(side, bottom - y)};
      block.cost = PredictTime(
          engine.config.tuning.timing,
          lens.renderer->measure_work(block.rendered, block.border, lens.frame_weights, {}, 0));
      blocks[count++] = block;
    }
  }
  return count;
}

// Divides the superblock into blocks. Returns the number of blocks.
int32_t PlanBlocks(const EngineState& engine, const Rect& superblock, const Scratch& scratch,
                   Block* blocks) {
  const Lens& lens = engine.lens;
  if (!IsPartitioned(lens)) return PlanWhole(engine, superblock, blocks);
  const PartitionRules rules = {engine.kernels,
                                &engine.config,
                                lens.renderer,
                                lens.weights_by_n,
                                lens.largest_n,
                                DemandOf(engine.tables->opening),
                                lens.scale,
                                lens.borders.cells,
                                LargestSide(engine),
                                engine.config.tuning.max_layer,
                                Gathers(engine.config, lens)};
  return PartitionBlock(rules, engine.stripe.cells, superblock.x, superblock.y, scratch.candidates,
                        scratch.cell_samples, engine.stripe.plan.gathered, blocks);
}

// Returns true if the region that the lens requests depends on pixels of `rect`.
bool IsInRegion(const EngineState& engine, const Rect& rect) {
  const Rect& region = engine.lens.region;
  const int32_t reach = engine.lens.borders.deblocked;
  // Deep pictures of 8 bits are dithered in groups of columns, which begin where blocks may begin.
  static_assert(simd::kDitherColumns == kSmallestBlock);
  const int32_t across = reach + (HasDeep(engine.config) ? kSmallestBlock - 1 : 0);
  return rect.x - across < region.x + region.width && region.x < rect.x + rect.width + across &&
         rect.y - reach < region.y + region.height && region.y < rect.y + rect.height + reach;
}

// Returns true if pixels of `rect` affect pixels that are not copied from the previous picture.
// Deblocking changes pixels within its reach of a changed pixel, and reads pixels within its reach
// of every pixel that it changes. The test therefore extends `rect` by twice the reach of
// deblocking.
bool IsNew(const EngineState& engine, const Rect& rect) {
  const int32_t reach = 2 * engine.lens.borders.deblocked;
  const FrameDiff& changes = engine.stripe.changes;
  return changes.before == nullptr ||
         HasChanged(changes, {rect.x - reach, rect.y - reach, rect.width + 2 * reach,
                              rect.height + 2 * reach});
}

// Moves the grid of cells to the stripe and its surroundings. Returns the first row of cells to
// measure; the cells above this row were measured for the previous stripe.
int32_t PlaceCells(const Range& rows, const Lens& lens, StripeState* state) {
  CellGrid& cells = state->cells;
  StripePlan& plan = state->plan;
  const int32_t first = Max(0, rows.first / kCellSize - lens.borders.cells);
  const int32_t last = (rows.last - 1) / kCellSize;
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

void MapBlock(const Range& rows, const Block& block, const LayerMap& map) {
  const Rect& rect = block.rect;
  for (int32_t y = rect.y; y < rect.y + rect.height; y += kSmallestBlock) {
    for (int32_t x = rect.x; x < rect.x + rect.width; x += kSmallestBlock) {
      map.At(x / kSmallestBlock, (y - rows.first) / kSmallestBlock) =
          static_cast<uint8_t>(block.layer);
    }
  }
}

// Sets all smallest blocks of the map to kNoLayer, which remains where no block covers the map.
void ClearMap(const Range& rows, LayerMap* map) {
  map->rows = (rows.count() + kSmallestBlock - 1) / kSmallestBlock;
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
  const starfocus_observer& observer = engine->observer;
  if (observer.on_block == nullptr) return;
  const starfocus_block told = {block.rect.x,      block.rect.y, block.rect.width,
                                block.rect.height, block.layer,  block.n};
  observer.on_block(observer.on_block_data, &told);
}

// Keeps the blocks that affect the requested pixels, and derives the inputs of the later phases
// from these blocks.
void ReadPlan(const Range& rows, EngineState* engine) {
  const FullConfig& config = engine->config;
  StripeLayers& layers = engine->layers;
  StripePlan& plan = engine->stripe.plan;
  plan.used = 0;
  ClearMap(rows, &engine->stripe.map);
  ClearLayerColumns(config, &layers);
  for (int32_t column = 0; column < plan.columns; ++column) {
    const Block* const planned = plan.BlocksOf(column);
    for (int32_t k = 0; k < plan.counts[column]; ++k) {
      if (!IsInRegion(*engine, planned[k].rect) || !IsNew(*engine, planned[k].rect)) continue;
      const Block& block = plan.blocks[plan.used++] = planned[k];
      MarkLayerColumns(config, block, &layers);
      MapBlock(rows, block, engine->stripe.map);
      ReportBlock(block, engine);
    }
  }
}

}  // namespace

void TakePlan(const FullConfig& config, Arena* arena, StripeState* stripe) {
  const Borders borders = LargestBorders(config);
  const int32_t side = config.superblock, columns = Columns(config), cells = side / kCellSize;
  const auto blocks = static_cast<size_t>(columns);
  stripe->cells.columns = (config.width + kCellSize - 1) / kCellSize;
  stripe->cells.rows = (config.height + kCellSize - 1) / kCellSize;
  stripe->cells.cells = arena->Take<Cell>(static_cast<size_t>(stripe->cells.columns),
                                          static_cast<size_t>(cells + 2 * borders.cells + 1));
  StripePlan& plan = stripe->plan;
  plan.side = side;
  plan.columns = columns;
  plan.wanted = arena->Take<uint8_t>(blocks);
  plan.measured = arena->Take<uint8_t>(blocks);
  plan.blocks = arena->Take<Block>(blocks, static_cast<size_t>(MaxBlocks(side)));
  plan.counts = arena->Take<int32_t>(blocks);
  plan.gathered.columns = columns * cells;
  plan.gathered.cells = arena->Take<uint8_t>(static_cast<size_t>(plan.gathered.columns * cells));
  stripe->map.columns = (config.width + kSmallestBlock - 1) / kSmallestBlock;
  stripe->map.layers = arena->Take<uint8_t>(static_cast<size_t>(stripe->map.columns),
                                            static_cast<size_t>(side / kSmallestBlock + 1));
}

bool ChooseColumns(const Range& rows, EngineState* engine) {
  const StripePlan& plan = engine->stripe.plan;
  const int32_t side = plan.side;
  std::memset(plan.measured, 0, static_cast<size_t>(plan.columns));
  bool any = false;
  for (int32_t column = 0; column < plan.columns; ++column) {
    const Rect block = {column * side, rows.first, side, rows.count()};
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

starfocus_status PlanStripe(const Range& rows, EngineState* engine) {
  const Lens& lens = engine->lens;
  bool has_lamps = false;
  if (engine->input.is_deep()) {
    // The excess of the brightest light of the stripe fits into 14 bits, or 15 if it is larger.
    const LightTile tiles =
        TilesAround(*engine, {0, rows.first, engine->config.width, rows.count()});
    engine->stripe.excess_shift = Max(0, 14 - tiles.excess_bits);
    has_lamps = tiles.excess_bits != 0;
  }
  StripePlan& plan = engine->stripe.plan;
  if (IsPartitioned(lens)) {
    plan.gathered.first_row = rows.first / kCellSize;
    const CellGrid& cells = engine->stripe.cells;
    const int32_t first_row = PlaceCells(rows, lens, &engine->stripe);
    const auto measure = [&](int32_t column, int32_t worker) {
      if (plan.measured[column] == 0) return;
      const int32_t per_block = plan.side / kCellSize, first = column * per_block;
      const int32_t last = Min(first + per_block, cells.columns);
      engine->scratch[worker].counts.measured_pixels +=
          PixelsIn(kCellSize * (last - first), kCellSize * (cells.last_row - first_row));
      for (int32_t row = first_row; row < cells.last_row; ++row) {
        MeasureCells(*engine->kernels, engine->input, lens.scale, row, {first, last},
                     cells.At(first, row));
        if (kDeep && has_lamps) MarkLamps(*engine, row, {first, last});
      }
    };
    const starfocus_status status = ForEach(plan.columns, engine->jobs, measure);
    if (status != STARFOCUS_OK) return status;
  }
  const auto divide = [&](int32_t column, int32_t worker) {
    const int32_t x = column * plan.side;
    const Rect superblock = {x, rows.first, Min(plan.side, engine->config.width - x), rows.count()};
    Block* const blocks = plan.BlocksOf(column);
    plan.counts[column] = 0;
    if (plan.wanted[column] == 0) return;
    plan.counts[column] = PlanBlocks(*engine, superblock, engine->scratch[worker], blocks);
    if (!IsPinhole(lens)) FindPasses(*engine, superblock, blocks, plan.counts[column]);
  };
  const starfocus_status status = ForEach(plan.columns, engine->jobs, divide);
  if (status == STARFOCUS_OK) ReadPlan(rows, engine);
  return status;
}

}  // namespace starfocus
