// SPDX-License-Identifier: Apache-2.0
#include "lib/plan/renderer.h"
#include "lib/slices/compositor.h"

namespace starfocus {
namespace {

int32_t LayerOf(const BlockStats& stats, Demand demand) {
  const double radius = static_cast<double>(stats.r_shown) / (1 << kDisparityBits);
  return LayerBySubaperture(radius, stats.has_edge, demand);
}

// Returns the predicted work of a block in the classes of the timing model, (13) to (15). Type A
// counts the pixels of slices that are shifted along rows, once for each column of views. Type C
// counts the pixels of slices that are composited, once for each view.
BlockWork MeasureWork(const Rect& rect, const Border& border, const ViewWeights& aperture,
                      const Content (&content)[2], int32_t layer) {
  const auto width = static_cast<uint64_t>(rect.width), height = static_cast<uint64_t>(rect.height);
  const uint64_t extended_width = width + static_cast<uint64_t>(border.left + border.right);
  const uint64_t extended_height = height + static_cast<uint64_t>(border.top + border.bottom);
  const auto all = static_cast<uint64_t>(aperture.views) - 1;
  const uint64_t along_axis = 2 * static_cast<uint64_t>(aperture.last);
  const uint64_t columns = all > 0 ? along_axis + 1 : 0;
  BlockWork work = {};
  work.field = extended_width * extended_height;
  work.a = columns * width * extended_height;
  work.c = (all - along_axis) * width * height;
  AddScans(columns, extended_height, content[0], layer, &work);
  AddScans(all - along_axis, width, content[1], layer, &work);
  return work;
}

// Allocates the memory of all data that is computed from a field before the slices of a tile are
// made. The memory for filling the surfaces overlaps the memory of the field.
void TakeField(size_t extended, Arena* arena, CompositorScratch* stack) {
  CompositorScratch& scratch = *stack;
  LayeredDepth& surfaces = scratch.surfaces;
  FillScratch& fill = scratch.fill;
  const size_t row = simd::SliceSamples(extended);
  for (uint16_t*& sources : surfaces.sources) sources = arena->Take<uint16_t>(extended * row);
  const size_t field = arena->Mark();
  scratch.field_rgb = arena->Take<int16_t>(extended * RgbStride(static_cast<int32_t>(extended)));
  scratch.field_disparity = arena->Take<int16_t>(extended * extended);
  for (uint8_t*& edges : surfaces.edges) {
    edges = arena->Take<uint8_t>(extended * row + simd::kSliceLanes);
  }
  surfaces.moved = arena->Take<int16_t>(row);
  surfaces.behind = arena->Take<int16_t>(row);
  surfaces.steps = arena->Take<simd::StepBits>(row / simd::kSliceLanes);
  scratch.bins = arena->Take<uint8_t>(kSliceBins);
  scratch.least_blur = arena->Take<int32_t>(extended);
  arena->Reuse(field);
  const size_t stride = FillStride(extended), behind = kFillStep;
  fill.disparity = arena->Take<int16_t>(extended * stride + behind);
  fill.rgb = arena->Take<int16_t>(3 * extended * stride + behind);
  fill.saved = arena->Take<int16_t>(3 * size_t{kFillStep + 1} * stride + behind);
  fill.source = arena->Take<uint16_t>(extended * stride);
  fill.farthest = arena->Take<uint8_t>(extended);
}

// Allocates the scratch memory of one worker; see Renderer::take_scratch.
void TakeScratch(const starfocus_config& config, size_t extended, size_t max_n, Arena* arena,
                 void* memory) {
  CompositorScratch counted;
  CompositorScratch& scratch =
      memory == nullptr ? counted : *static_cast<CompositorScratch*>(memory);
  LayeredDepth& surfaces = scratch.surfaces;
  const size_t area = extended * simd::SliceSamples(extended) + simd::kSliceLanes;
  for (int k = 0; k < simd::kSurfaces; ++k) {
    // LookBehind reads kSliceLanes samples before the first pixel of a row and ignores their
    // values.
    int16_t* before = arena->Take<int16_t>(simd::kSliceLanes + area);
    surfaces.disparity[k] = before == nullptr ? nullptr : before + simd::kSliceLanes;
    surfaces.rgb[k] = arena->Take<int16_t>(3 * area);
  }
  surfaces.share = arena->Take<uint8_t>(area);
  surfaces.hiding = arena->Take<uint64_t>(extended);
  scratch.offsets = arena->Take<simd::SliceOffset>(kMaxSlices * (2 * max_n + 1));
  scratch.weights = arena->Take<int16_t>(Min(2 * max_n + 1, size_t{kGroupViews}));
  scratch.pairs = arena->Take<CellPair>(CellPairs(config.superblock));
  const auto rows = static_cast<size_t>(LargestTile(config.superblock));
  scratch.sums = arena->Take<uint32_t>(kPixelSums * simd::kSliceLanes * rows);
  const size_t field = arena->Mark();
  TakeField(extended, arena, &scratch);
  arena->Reuse(field);
  // Memory for parts of a tile of up to 64x64 pixels. With this size, the engine executes 1.7 %
  // fewer instructions than with smaller parts.
  const auto tile = static_cast<size_t>(Min(config.superblock, kSliceTile));
  const size_t pool = Max(LeastPool(config.max_blur), 119 * tile * tile);
  scratch.pool_bytes = Max(pool, arena->Shared());
  scratch.pool = arena->Take<uint8_t>(scratch.pool_bytes);
}

}  // namespace

const Renderer kSliceRenderer = {
    0, true,
    // Side of the superblocks of mode `benchmark`. A superblock of 32 pixels has so few fine slices
    // that these slices fit into the memory for coarse slices.
    32, ViewsBySubaperture, LayerOf, MakeSubapertures, MeasureWork, sizeof(CompositorScratch),
    TakeScratch,
    // nothing_moves returns false, because even the smallest shift moves the pixels at the boundary
    // of a slice (OffsetOf in slice_plane.cc).
    [](const RenderJob&) { return false; }, CompositeRectangle,
    [](const ViewWeights&) { return kCompositeBits; }};

}  // namespace starfocus
