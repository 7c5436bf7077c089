// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/layout.h"

#include "lib/base/features.h"
#include "lib/engine/stripe_coverage.h"
#include "lib/io/block_pixels.h"
#include "lib/optics/rules.h"

namespace starfocus {
namespace {

// Allocates the memory for subsampling a column of superblocks.
void TakeResample(const starfocus_config& config, Arena* arena, ResampleScratch* resample) {
  // The last column of superblocks includes one or two pixels of a layer that lie beyond the
  // picture.
  const auto side = config.superblock;
  const auto columns = static_cast<size_t>(Max(side / 2 + 1, TapsOfLayer(side / 4 + 2)));
  const int32_t above_two = TapsOfLayer(LayerRows(config, 2));
  const auto rows = static_cast<size_t>(TapsOfLayer(Max(LayerRows(config, 1), above_two)));
  resample->even = arena->Take<int16_t>(3 * (columns + 3));
  resample->odd = arena->Take<int16_t>(3 * (columns + 3));
  resample->half = arena->Take<int16_t>(3 * columns, rows);
  resample->above = arena->Take<int16_t>(3 * columns, static_cast<size_t>(above_two));
}

// Rendering and partitioning use the same memory, because a worker runs these steps in turn and
// keeps only the sums of the rendered pixels.
Scratch TakeScratch(const starfocus_config& config, Arena* arena) {
  const auto side = static_cast<size_t>(config.superblock);
  const Borders borders = LargestBorders(config);
  Scratch scratch = {};
  const size_t extended = side + 2 * static_cast<size_t>(borders.layer[0]);
  const int32_t renderers = RendererCount(config);
  int32_t max_n[kMaxRenderers] = {}, most = 0;
  for (int32_t k = 0; k < renderers; ++k) {
    max_n[k] = Max(LargestN(config, *kRenderers[k], Demand::kRing, config.max_blur),
                   ViewsOfBenchmark(config.max_blur));
    most = Max(most, max_n[k]);
    scratch.renderers[k] = arena->Take<uint8_t>(kRenderers[k]->scratch_bytes);
  }
  scratch.sums = arena->Take<uint32_t>(3 * side * side);
  if (HasShapes(config)) scratch.aperture_weights = arena->Take<uint16_t>(FullApertureSize(most));
  if (config.highlights > 1) scratch.lamp_runs = arena->Take<LampRuns>(1);
  const size_t shared = arena->Mark();
  // The slice renderer is laid out last, because its pool of slices uses all memory that it shares
  // with other steps.
  for (int32_t k = renderers - 1; k >= 0; --k) {
    kRenderers[k]->take_scratch(config, extended, static_cast<size_t>(max_n[k]), arena,
                                scratch.renderers[k]);
    arena->Reuse(shared);
  }
  // `field` and `layer_samples` do not share memory, because gathering reads `field` and writes to
  // `layer_samples`.
  const size_t half = side / 2 + 2 * static_cast<size_t>(LayerMargin(1));
  scratch.layer_samples = arena->Take<int16_t>(3 * half * half);
  const size_t behind = arena->Mark();
  scratch.field.rgb = arena->Take<int16_t>(extended * RgbStride(static_cast<int32_t>(extended)));
  scratch.field.disparity = arena->Take<int16_t>(extended * extended);
  scratch.spans = TakeSpans(extended, arena);
  arena->Reuse(behind);
  scratch.upsample.line = arena->Take<int16_t>(3 * half);
  scratch.upsample.between = arena->Take<int16_t>(3 * half);
  scratch.upsample.even = arena->Take<int16_t>(3 * half);
  scratch.middle_samples = arena->Take<int16_t>(3 * half * half);
  scratch.picture_samples = arena->Take<int16_t>(3 * side * side);
  arena->Reuse(shared);
  TakeResample(config, arena, &scratch.resample);
  arena->Reuse(shared);
  scratch.partition.candidates =
      arena->Take<PartitionCandidate>(static_cast<size_t>(PartitionCandidates(config.superblock)));
  scratch.partition.cells =
      arena->Take<int16_t>(SurroundingSamples(config.superblock / kCellSize, borders.cells));
  arena->GoOn();
  return scratch;
}

void TakeTables(const starfocus_config& config, Arena* arena, Tables* tables) {
  const bool full = HasShapes(config);
  const auto weights_of = [&](int32_t n) {
    return full ? FullApertureSize(n) : ViewWeightsSize(n);
  };
  for (int32_t k = 0; k < RendererCount(config); ++k) {
    const int32_t last = LargestN(config, *kRenderers[k], Demand::kRing, config.max_blur);
    size_t weights = 0;
    for (int32_t n = 0; n <= last; ++n) weights += weights_of(n);
    tables->apertures[k].apertures = arena->Take<ViewWeights>(static_cast<size_t>(last) + 1);
    tables->apertures[k].weights = arena->Take<uint16_t>(weights);
  }
  const int32_t benchmark_n = ViewsOfBenchmark(config.max_blur);
  const auto steps = static_cast<size_t>(BlurStepCount(config.max_blur));
  tables->benchmark_weights = arena->Take<uint16_t>(weights_of(benchmark_n));
  tables->psfs = arena->Take<Psf>(steps);
  tables->blur_weights = arena->Take<uint16_t>(BlurWeightCount(full, config.max_blur));
}

// Allocates the planes of layers 1 and 2 around a stripe.
void TakeLayers(const starfocus_config& config, Arena* arena, EngineState* engine) {
  for (int layer = 1; layer <= config.tuning.max_layer; ++layer) {
    LayerPlane& plane = engine->row_store.layers[layer];
    const auto width = static_cast<size_t>(LayerSize(config.width, layer));
    plane.samples.stride = 3 * width;
    plane.samples.data =
        arena->Take<int16_t>(3 * width, static_cast<size_t>(LayerRows(config, layer)));
  }
}

void TakeStripe(const starfocus_config& config, Arena* arena, EngineState* engine) {
  const Borders borders = LargestBorders(config);
  const int32_t side = config.superblock;
  const auto blocks = static_cast<size_t>((config.width + side - 1) / side);
  engine->stripe.cells.columns = (config.width + kCellSize - 1) / kCellSize;
  engine->stripe.cells.rows = (config.height + kCellSize - 1) / kCellSize;
  engine->stripe.cells.cells =
      arena->Take<Cell>(static_cast<size_t>(engine->stripe.cells.columns) *
                        static_cast<size_t>(side / kCellSize + 2 * borders.cells + 1));
  TakeCoverage(config, borders.parted, arena, &engine->stripe.coverage);
  engine->stripe.plan.side = side;
  engine->stripe.plan.columns = static_cast<int32_t>(blocks);
  engine->stripe.plan.wanted = arena->Take<uint8_t>(blocks);
  engine->stripe.plan.measured = arena->Take<uint8_t>(blocks);
  engine->stripe.plan.blocks = arena->Take<Block>(blocks * static_cast<size_t>(MaxBlocks(side)));
  engine->stripe.plan.counts = arena->Take<int32_t>(blocks);
  engine->stripe.plan.gathered.columns = static_cast<int32_t>(blocks) * side / kCellSize;
  engine->stripe.plan.gathered.cells = arena->Take<uint8_t>(
      static_cast<size_t>(engine->stripe.plan.gathered.columns * (side / kCellSize)));
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    engine->row_store.needed[layer] = arena->Take<uint8_t>(blocks);
  }
  FrameDiff& changes = engine->stripe.changes;
  changes.columns = static_cast<int32_t>(blocks);
  // For videos, the engine compares input rows up to borders.views rows below the next stripe. The
  // compared rows flag stripes that start up to borders.views rows farther down. The ring of flags
  // also keeps the flags of the previous stripe.
  changes.stripes = 2 * borders.views / side + 5;
  changes.flags = arena->Take<uint8_t>(blocks * static_cast<size_t>(changes.stripes));
  engine->stripe.map.columns = (config.width + kSmallestBlock - 1) / kSmallestBlock;
  engine->stripe.map.layers = arena->Take<uint8_t>(static_cast<size_t>(engine->stripe.map.columns) *
                                                   static_cast<size_t>(side / kSmallestBlock + 1));
}

// Allocates the memory for images. `rows` is the number of rows in the ring of the centre view.
void TakeImages(const starfocus_config& config, int32_t rows, Arena* arena, ImageMemory* images) {
  const auto width = static_cast<size_t>(config.width);
  images->columns = arena->Take<uint32_t>(width);
  images->odd_row = arena->Take<uint8_t>(3 * width);
  if (!Has(config.features, STARFOCUS_FEATURE_STREAMING)) return;
  // The ring keeps the alpha of the previous stripe, because the last rows of the previous stripe
  // are written together with the current stripe.
  images->alpha.rows = rows + config.superblock + kDeblockRows;
  images->alpha.stride = width;
  images->alpha.data = arena->Take<uint8_t>(width, static_cast<size_t>(images->alpha.rows));
}

void TakeRows(const starfocus_config& config, Arena* arena, EngineState* engine) {
  const auto width = static_cast<size_t>(config.width);
  const bool streaming = Has(config.features, STARFOCUS_FEATURE_STREAMING);
  const Borders borders = LargestBorders(config);
  const int32_t rows = config.superblock + 2 * (streaming ? borders.streamed : borders.centre);
  engine->row_store.disparity.rows = rows;
  engine->row_store.disparity.stride = width;
  engine->row_store.disparity.data = arena->Take<int16_t>(width, static_cast<size_t>(rows));
  engine->stripe.out =
      arena->Take<uint8_t>(3 * width, static_cast<size_t>(config.superblock + kDeblockRows));
  // Sets `last_rows` to null without streaming, because LayOutAnew may reuse a streaming engine.
  engine->stripe.last_rows = streaming ? arena->Take<uint8_t>(3 * width, kDeblockRows) : nullptr;
  const int rings = streaming                                        ? config.views
                    : Has(config.features, STARFOCUS_FEATURE_IMAGES) ? 1
                                                                     : 0;
  if (streaming && HasCoverage(config)) {
    engine->stripe.coverage.given.rows = rows;
    engine->stripe.coverage.given.stride = width;
    engine->stripe.coverage.given.data = arena->Take<uint8_t>(width, static_cast<size_t>(rows));
  }
  for (int view = 0; view < rings; ++view) {
    engine->rings[view].rows = rows;
    engine->rings[view].stride = 3 * width;
    engine->rings[view].data = arena->Take<uint8_t>(3 * width, static_cast<size_t>(rows));
  }
  if (Has(config.features, STARFOCUS_FEATURE_IMAGES))
    TakeImages(config, rows, arena, &engine->images);
}

size_t Carve(const starfocus_config& config, Arena arena, EngineState** engine) {
  *engine = arena.Take<EngineState>(1);
  EngineState counted;  // replaces *engine while the layout only counts
  EngineState& e = *engine == nullptr ? counted : **engine;
  TakeTables(config, &arena, &e.tables);
  e.workers.jobs.max_workers = config.max_workers;
  e.workers.scratch = arena.Take<Scratch>(static_cast<size_t>(config.max_workers));
  for (int32_t worker = 0; worker < config.max_workers; ++worker) {
    const Scratch taken = TakeScratch(config, &arena);
    if (*engine == nullptr) continue;
    e.workers.scratch[worker] = taken;
    e.workers.scratch[worker].cancel = CancelToken(&e.workers.jobs.call_progress);
  }
  // Pieces that depend on the size of the picture come last, so that LayOutAnew for a smaller
  // picture does not move the other pieces.
  TakeRows(config, &arena, &e);
  TakeLayers(config, &arena, &e);
  TakeStripe(config, &arena, &e);
  e.workers.jobs.progress =
      arena.Take<std::atomic<uint32_t>>(ProgressWords(static_cast<size_t>(MaxJobs(config))));
  return arena.Bytes();
}

#ifdef STARFOCUS_RED_ZONES
void VisitZones(EngineState* engine, void (*visit)(void*, size_t, size_t)) {
  const PieceVisitor zones = {visit, engine};
  EngineState* counted = nullptr;
  LayOut(engine->config, nullptr, &counted, &zones);
}
#endif

}  // namespace

size_t LayOut(const starfocus_config& config, void* base, EngineState** engine,
              const PieceVisitor* pieces) {
  return Carve(config, Arena(base, PTRDIFF_MAX, pieces), engine);
}

void LayOutAnew(const starfocus_config& config, EngineState* engine) {
  EngineState* same = nullptr;
  Carve(config, Arena(engine), &same);
  engine->config = config;
  engine->images.map_width = 0;
}

#ifdef STARFOCUS_RED_ZONES
RedZones::RedZones(EngineState* engine) : engine_(engine) { VisitZones(engine, PoisonZone); }
RedZones::~RedZones() { VisitZones(engine_, UnpoisonZone); }
#else
RedZones::RedZones(EngineState* engine) : engine_(engine) {}
RedZones::~RedZones() = default;
#endif

Extent Workspace(const EngineState& engine) {
  EngineState* counted = nullptr;
  return ExtentOf(&engine, 0, 1, LayOut(engine.config, nullptr, &counted));
}

}  // namespace starfocus
