// SPDX-License-Identifier: Apache-2.0
#include "lib/engine/engine.h"

#include <cstring>
#include <new>

#include "lib/io/deep.h"
#include "lib/optics/rules.h"

namespace starfocus {

int32_t MaxJobs(const FullConfig& config) {
  const int32_t side = config.superblock;
  // A set has one job per block of a stripe, or one job per column of superblocks. Deblocking has
  // one job per row of smallest blocks in a stripe and in the rows kept above the stripe. A stripe
  // never has more columns of superblocks than blocks.
  return Max(Columns(config) * MaxBlocks(side), side / kSmallestBlock + 1);
}

// An engine, and what its calls change for later calls. All copies of an engine share the latter.
struct EngineMemory {
  EngineState engine;
  Tables tables;
  Jobs jobs;
};

namespace {

// Memory of blocks that are blurred without views, and of layers that are upsampled.
void TakeUpsampling(const FullConfig& config, size_t extended, Arena* arena, Scratch* scratch) {
  const auto side = static_cast<size_t>(config.superblock);
  const size_t half = side / 2 + 2 * static_cast<size_t>(UpsampleBorder(1));
  // Gathering reads `field` and writes to `layer_samples`.
  scratch->layer_samples = arena->Take<int16_t>(3 * half * half);
  const auto gather = [&] {
    const size_t stride = RgbStride(static_cast<int32_t>(extended));
    scratch->block_rgb = arena->Take<int16_t>(extended * stride);
    scratch->block_disparity = arena->Take<int16_t>(extended * extended);
  };
  const auto upsample = [&] {
    scratch->upsample.line = arena->Take<int16_t>(3 * half);
    scratch->upsample.between = arena->Take<int16_t>(3 * half);
    scratch->upsample.even = arena->Take<int16_t>(3 * half);
    scratch->middle_samples = arena->Take<int16_t>(3 * half * half);
    scratch->picture_samples = arena->Take<int16_t>(3 * side * side);
  };
  arena->Overlap(gather, upsample);
}

// A worker runs one step at a time, and keeps only the sums of the rendered pixels. Therefore the
// steps share memory.
Scratch TakeScratch(const FullConfig& config, Arena* arena) {
  const auto side = static_cast<size_t>(config.superblock);
  const Borders borders = LargestBorders(config);
  Scratch scratch = {};
  const size_t extended = side + 2 * static_cast<size_t>(borders.layer[0]);
  const int32_t renderers = RendererCount(config);
  int32_t max_n[kMaxRenderers] = {}, most = 0;
  for (int32_t k = 0; k < renderers; ++k) {
    max_n[k] = Max(LargestN(config, RendererAt(config, k), Demand::kRing, config.max_blur),
                   ViewsOfBenchmark(config.max_blur));
    most = Max(most, max_n[k]);
    scratch.renderers[k] = reinterpret_cast<RendererScratch*>(
        arena->Take<uint8_t>(RendererAt(config, k).scratch_bytes));
  }
  scratch.sums = arena->Take<uint32_t>(3 * side * side);
  if (Has(config, STARFOCUS_FEATURE_SHAPES))
    scratch.aperture_weights = arena->Take<uint16_t>(FullApertureSize(most));
  if (config.highlights > 1) scratch.lamp_lengths = arena->Take<LampLengths>(1);
  const auto renderer = [&](int32_t k) {
    if (k >= renderers) return;
    RendererAt(config, k).take_scratch(config, extended, static_cast<size_t>(max_n[k]), arena,
                                       scratch.renderers[k]);
  };
  const auto partition = [&] {
    scratch.candidates = arena->Take<PartitionCandidate>(
        static_cast<size_t>(PartitionCandidates(config.superblock)));
    scratch.cell_samples =
        arena->Take<int16_t>(SurroundingSamples(config.superblock / kCellSize, borders.cells));
  };
  // The slices come last, because their pool fills the memory of the longest other step.
  arena->Overlap([&] { renderer(kMaxRenderers - 1); },
                 [&] { TakeUpsampling(config, extended, arena, &scratch); },
                 [&] { TakeResample(config, arena, &scratch.resample); }, partition,
                 [&] { renderer(kSliceRenderer.index); });
  return scratch;
}

void TakePictureRows(size_t width, int32_t rows, bool deep, Arena* arena, PictureRows* out) {
  *out = {};
  if (deep) {
    out->deep = TakePlane<uint16_t>(3 * width, rows, arena);
    out->alpha = TakePlane<uint16_t>(width, rows, arena);
  } else {
    out->codes = TakePlane<uint8_t>(3 * width, rows, arena);
  }
}

void TakeRows(const FullConfig& config, Arena* arena, EngineState* engine) {
  const auto width = static_cast<size_t>(config.width);
  const bool streaming = Has(config, STARFOCUS_FEATURE_STREAMING);
  const Borders borders = LargestBorders(config);
  const int32_t rows = config.superblock + 2 * (streaming ? borders.streamed : borders.centre);
  // The last rows of a stripe are written together with the next stripe.
  TakeInput(config, rows, rows + config.superblock + kDeblockRows, arena, &engine->rings);
  engine->rings.tables = engine->deep;
  const int32_t out_rows = config.superblock + kDeblockRows;
  const bool deep = HasDeep(config);
  TakePictureRows(width, out_rows, deep, arena, &engine->stripe.out);
  engine->stripe.last_rows = {};
  if (streaming) TakePictureRows(width, kDeblockRows, deep, arena, &engine->stripe.last_rows);
  const size_t odd_bytes = (deep ? 6 : 3) * width;
  engine->odd_row = ReadsImages(config) ? arena->Take<uint8_t>(odd_bytes) : nullptr;
  engine->dithered = engine->dithered_alpha = {};
  if (!deep) return;
  engine->dithered = TakePlane<uint8_t>(3 * width, out_rows, arena);
  engine->dithered_alpha = TakePlane<uint8_t>(width, out_rows, arena);
}

// Allocates what does not depend on the size of the picture: pieces of memory that the pictures of
// previews use as well.
void TakeShared(const FullConfig& config, Arena* arena, EngineMemory* memory) {
  TakeTables(config, arena, &memory->tables);
  memory->jobs.max_workers = config.max_workers;
  memory->jobs.progress =
      arena->Take<std::atomic<uint32_t>>(ProgressWords(static_cast<size_t>(MaxJobs(config))));
  auto* const scratch = arena->Take<Scratch>(static_cast<size_t>(config.max_workers));
  for (int32_t worker = 0; worker < config.max_workers; ++worker) {
    const Scratch taken = TakeScratch(config, arena);
    if (scratch == nullptr) continue;
    scratch[worker] = taken;
    scratch[worker].cancel = CancelToken(&memory->jobs.call_progress);
  }
  memory->engine.scratch = scratch;
  const bool deep = HasDeep(config);
  memory->engine.deep = deep ? arena->Take<DeepTables>(1) : nullptr;
}

void TakePicture(const FullConfig& config, Arena* arena, EngineState* engine) {
  TakeRows(config, arena, engine);
  TakeLayers(config, arena, &engine->layers);
  TakePassLayers(config, arena, engine);
  const Borders borders = LargestBorders(config);
  TakeCoverage(config, borders.matting, arena, &engine->stripe.coverage);
  TakeRims(config, borders.layer[0], arena, &engine->stripe.rims);
  TakePlan(config, arena, &engine->stripe);
  TakeFrameDiff(config, borders.views, arena, &engine->stripe.changes);
}

// Allocates an engine of `config`, with the pieces of a picture of `picture`. Returns *counted if
// the arena only counts.
EngineMemory& TakeEngine(const FullConfig& config, const FullConfig& picture, Arena* arena,
                         EngineMemory* counted) {
  auto* const taken = arena->Take<EngineMemory>(1);
  EngineMemory& memory = taken == nullptr ? *counted : *new (taken) EngineMemory();
  TakeShared(config, arena, &memory);
  memory.engine.picture_memory = arena->Here();
  TakePicture(picture, arena, &memory.engine);
  return memory;
}

#ifdef STARFOCUS_RED_ZONES
void VisitZones(const EngineState& engine, void (*visit)(void*, size_t, size_t)) {
  const PieceVisitor zones = {visit, engine.memory};
  Arena arena(nullptr, PTRDIFF_MAX, &zones);
  EngineMemory counted;
  TakeEngine(engine.memory->engine.config, engine.config, &arena, &counted);
}
#endif

}  // namespace

size_t LayOut(const FullConfig& config, void* base, EngineState** engine,
              const PieceVisitor* pieces) {
  Arena arena(base, PTRDIFF_MAX, pieces);
  EngineMemory counted;
  EngineMemory& memory = TakeEngine(config, config, &arena, &counted);
  EngineState& made = memory.engine;
  made.config = config;
  made.config.problem = &made.problem;
  made.kernels = &simd::BestKernels();
  made.tables = &memory.tables;
  made.jobs = &memory.jobs;
  made.memory = &memory;
  made.bytes = arena.Bytes();
  *engine = base == nullptr ? nullptr : &made;
  if (kDeep && base != nullptr && made.deep != nullptr) FillDeepTables(config.transfer, made.deep);
  return made.bytes;
}

Output OutputOf(const EngineState& engine, const starfocus_image& image, const Rect& rect) {
  return {&simd::BestImageKernels(),
          engine.deep,
          PlanesOf<uint8_t>(image),
          rect,
          engine.dithered,
          engine.dithered_alpha,
          engine.odd_row,
          {},
          1};
}

Input InputOf(const EngineState& engine, Pass pass, const Scratch& scratch) {
  Input in = kDeep && pass == kAlphaPass ? DeepAlphaOf(engine.input)
             : kDeep && engine.input.is_deep()
                 ? DeepExcessOf(engine.input, engine.stripe.excess_shift)
                 : ExcessOf(engine.input, engine.config.highlights, scratch.lamp_lengths);
  in.captured = &engine.input;
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    const Plane<int16_t>& from = engine.pass_layers[pass][layer].samples;
    in.layers[layer] = {from.data, from.stride, from.rows, from.first};
  }
  return in;
}

EngineState PreviewEngine(const FullConfig& config, EngineState* engine) {
  engine->stream.active = false;
  // The pictures of the preview and of the engine share memory, which includes the columns of the
  // map, so that both must set them anew.
  engine->rings.map_width = 0;
  EngineState preview = *engine;
  preview.config = config;
  Arena arena(engine->picture_memory);
  TakePicture(config, &arena, &preview);
  return preview;
}

#ifdef STARFOCUS_RED_ZONES
RedZones::RedZones(const EngineState& engine) : engine_(engine) { VisitZones(engine, PoisonZone); }
RedZones::~RedZones() { VisitZones(engine_, UnpoisonZone); }
#else
RedZones::RedZones(const EngineState& engine) : engine_(engine) {}
RedZones::~RedZones() = default;
#endif

Extent Workspace(const EngineState& engine) { return ExtentOf(engine.memory, 0, 1, engine.bytes); }

namespace {

void Add(const starfocus_layer_report& part, starfocus_layer_report* sum) {
  sum->blocks += part.blocks;
  sum->pixels += part.pixels;
  sum->views += part.views;
  sum->rendered_samples += part.rendered_samples;
  sum->predicted_ps += part.predicted_ps;
  sum->measured_ns += part.measured_ns;
  sum->surface_pixels += part.surface_pixels;
  sum->hidden_pixels += part.hidden_pixels;
  sum->filled_pixels += part.filled_pixels;
  sum->selected_pixels += part.selected_pixels;
  sum->shifted_pixels += part.shifted_pixels;
  sum->composited_pixels += part.composited_pixels;
}

void Add(const Counts& counts, FullReport* report) {
  for (int layer = 0; layer < STARFOCUS_LAYERS; ++layer) {
    Add(counts.layers[layer], &report->layers[layer]);
    report->rendered_samples += counts.layers[layer].rendered_samples;
  }
  report->copied_pixels += counts.copied_pixels;
  report->gathered_pixels += counts.gathered_pixels;
  report->unknown_pixels += counts.unknown_pixels;
  report->converted_pixels += counts.converted_pixels;
  report->measured_pixels += counts.measured_pixels;
}

}  // namespace

starfocus_status SetLens(const FullParams& params, EngineState* engine) {
  const starfocus_status status =
      MakeLens(engine->config, params, &engine->jobs->call_progress, engine->tables, &engine->lens);
  if (status != STARFOCUS_OK) return status;
  engine->report = FullReport();
  engine->report.r_max = engine->lens.r_max;
  engine->report.superblock = engine->config.superblock;
  DropCounts(engine);
  engine->stripe.changes.before = nullptr;
  ForgetStripe(&engine->stripe);
  ForgetLayers(engine->config, &engine->layers);
  return STARFOCUS_OK;
}

void ReportCounts(EngineState* engine) {
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    Add(engine->scratch[worker].counts, &engine->report);
  }
  DropCounts(engine);
}

void DropCounts(EngineState* engine) {
  for (int32_t worker = 0; worker < engine->config.max_workers; ++worker) {
    engine->scratch[worker].counts = Counts();
  }
}

void WriteReport(const EngineState& engine, starfocus_report* report) {
  if (report == nullptr) return;
  // A shorter, older report has no `layers`, which then stays null.
  starfocus_report given = {};
  std::memcpy(&given, report, report->size);
  starfocus_report written = engine.report;
  written.size = given.size;
  written.layers = given.layers;
  std::memcpy(report, &written, given.size);
  if (given.layers == nullptr) return;
  std::memcpy(given.layers, engine.report.layers, sizeof engine.report.layers);
}

void ForgetStripe(StripeState* stripe) {
  std::memset(stripe->map.layers, kNoLayer, static_cast<size_t>(stripe->map.columns));
  stripe->plan.all_measured = false;
  ForgetCoverage(&stripe->coverage);
  ForgetRims(&stripe->rims);
}

void ForgetLayers(const FullConfig& config, StripeLayers* layers) {
  for (int layer = 1; layer < STARFOCUS_LAYERS; ++layer) {
    LayerPlane& plane = layers->planes[layer];
    plane.width = LayerSize(config.width, layer);
    plane.height = LayerSize(config.height, layer);
    // The ring holds the largest number of rows that a stripe may read, so that rows of the
    // previous stripe are kept.
    plane.samples.rows = LayerRows(config, layer);
    plane.rows = {0, 0};
    std::memset(layers->needed[layer], 0, static_cast<size_t>(Columns(config)));
  }
}

}  // namespace starfocus
