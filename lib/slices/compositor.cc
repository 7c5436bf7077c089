// SPDX-License-Identifier: Apache-2.0
#include "lib/slices/compositor.h"

#include <cstring>

#include "lib/io/block_pixels.h"
#include "lib/matting/mixed_pixels.h"
#include "lib/plan/renderer.h"

namespace starfocus {
namespace {

// Returns the centre view's light of a row of the rectangle: 3 * width samples in the second half
// of the row's accumulators. The accumulators are written from left to right. The first 3 * n
// accumulators overlap the light of the first 2 n - width pixels. Since 2 n - width <= n, only the
// light of finished pixels is overwritten.
int16_t* CentreRow(uint32_t* accumulators, int32_t width) {
  return reinterpret_cast<int16_t*>(accumulators) + 3 * static_cast<size_t>(width);
}

// A batch of a bucket, so small that all slices of the part are in memory at once.
class Batch {
 public:
  Batch(const RenderJob& job, const SliceStack& stack, const CompositorScratch& scratch,
        const Rect& rect, uint32_t* accumulators)
      : job_(job), stack_(stack), scratch_(scratch), rect_(rect), accumulators_(accumulators) {}

  // Composites the part. Returns the number of pixels rendered in each view, summed over all
  // slices.
  uint64_t Refocus() {
    int16_t* const strip_memory = PlaceSlices();
    const uint64_t pixels = FindPairs();
    const CellPair *first = scratch_.pairs, *const last = first + pairs_;
    for (int32_t x = 0; x < rect_.width && GoesOn(job_.cancel, 0); x += simd::kStripColumns) {
      const CellPair* end = first;
      while (end < last && end->x == x) ++end;
      if (first < end) {
        job_.counts->shifted_pixels +=
            CompositeStrip(*job_.input->kernels, stack_, planes_, first, end, strip_memory,
                           scratch_.sums, job_.cancel);
      }
      FinishStrip(x, first, end);
      first = end;
    }
    return pixels;
  }

 private:
  // Makes the slices of the part and stores them contiguously in the pool. Returns a pointer to the
  // memory after the slices, which is scratch memory for filtering.
  int16_t* PlaceSlices() {
    const Rect rect = {stack_.inner.x + rect_.x, stack_.inner.y + rect_.y, rect_.width,
                       rect_.height};
    uint8_t* next = scratch_.pool;
    for (int32_t k = 0; k < stack_.count; ++k) {
      SlicePlane& placed = planes_[k];
      PlaceSlice(*stack_.grid, stack_.slices[k].disparity, rect, &placed);
      const auto rows = static_cast<size_t>(placed.rows);
      placed.cover = reinterpret_cast<simd::SliceCover*>(next);
      placed.samples = reinterpret_cast<int16_t*>(next + CoverBytes(rows)) + simd::kStripColumns;
      next += SliceBytes(static_cast<size_t>(rect.width), static_cast<size_t>(rect.height),
                         static_cast<size_t>(placed.reach));
    }
    int16_t* const behind = reinterpret_cast<int16_t*>(next);
    for (int32_t k = 0; k < stack_.count; ++k) {
      job_.counts->selected_pixels += FillSlice(*job_.input->kernels, scratch_.surfaces,
                                                stack_.slices[k], rect, behind, planes_[k]);
    }
    return behind;
  }

  bool IsGathered(const CellPair& pair) const {
    if (job_.gathered == nullptr) return false;
    return job_.gathered->AreGathered({job_.rect.x + rect_.x + pair.x,
                                       job_.rect.y + rect_.y + pair.y,
                                       Min(simd::kStripColumns, rect_.width - pair.x), pair.rows});
  }

  // Finds, for each pair of cells, the slices that some view shows in these cells. Returns the
  // number of pixels rendered in each view, summed over all slices.
  uint64_t FindPairs() {
    static_assert(kLeastRows == kCellSize && simd::kStripColumns % kCellSize == 0,
                  "pairs are whole cells");
    uint64_t pixels = 0;
    for (int32_t x = 0; x < rect_.width; x += simd::kStripColumns) {
      for (int32_t y = 0; y < rect_.height; y += kLeastRows) {
        CellPair& pair = scratch_.pairs[pairs_];
        pair = {x, y, Min(kLeastRows, rect_.height - y), 0, {}};
        if (IsGathered(pair)) continue;
        ++pairs_;
        for (int32_t k = 0; k < stack_.count; ++k) {
          const simd::SliceCover cover = CoverOf(planes_[k], pair);
          if (cover.some != 0) pair.shown[pair.count++] = static_cast<uint8_t>(k);
          if (cover.all != 0) break;
        }
        const uint64_t inside = PixelsIn(Min(simd::kStripColumns, rect_.width - x), pair.rows);
        job_.counts->composited_pixels += inside;
        pixels += static_cast<uint64_t>(pair.count) * inside;
      }
    }
    return pixels;
  }

  // Tests whether a slice covers the pixels that at least one view shows in a pair of cells. In the
  // result, `some` contains the strips in which the slice covers any tested pixel. `all` is 1 if
  // the slice covers all tested pixels, and 0 otherwise.
  static simd::SliceCover CoverOf(const SlicePlane& placed, const CellPair& pair) {
    const uint64_t strips = StripsOf(placed, pair.x);
    simd::SliceCover cover = {0, strips};
    for (int32_t row = pair.y; row < pair.y + pair.rows + 2 * placed.reach; ++row) {
      cover.some |= placed.cover[row].some;
      cover.all &= placed.cover[row].all;
    }
    return {cover.some & strips, cover.all == strips ? uint64_t{1} : 0};
  }

  // Writes the accumulators of a strip. The cell pairs of the strip are [first, end); the other
  // cells are later blurred without views.
  void FinishStrip(int32_t x, const CellPair* first, const CellPair* end) {
    int32_t row = 0;
    for (const CellPair* pair = first; pair < end; ++pair) {
      ClearRows(x, row, pair->y);
      row = pair->y + pair->rows;
      FinishRows(x, pair->y, row);
    }
    ClearRows(x, row, rect_.height);
  }

  // Divides the summed colours by the summed coverage. Pixels that hardly any view shows get the
  // colour of the centre view.
  void FinishRows(int32_t x, int32_t first, int32_t end) {
    const size_t columns = Columns(x), left = 3 * static_cast<size_t>(rect_.x + x);
    int16_t centre[3 * simd::kStripColumns + simd::kPadding / sizeof(int16_t)] = {};
    for (int32_t row = first; row < end; ++row) {
      const size_t at = FirstSample(x, row);
      std::memcpy(centre, CentreRow(accumulators_ + at - left, job_.rect.width) + left,
                  3 * columns * sizeof(*centre));
      job_.input->kernels->FinishComposite(SumsOfRow(scratch_.sums, row), simd::kSliceLanes, centre,
                                           stack_.least_covered, kCompositeBits, columns,
                                           accumulators_ + at);
    }
  }

  // Clears the accumulators of rows [first, end), whose cells are later blurred without views.
  void ClearRows(int32_t x, int32_t first, int32_t end) {
    for (int32_t row = first; row < end; ++row) {
      std::memset(accumulators_ + FirstSample(x, row), 0, 3 * Columns(x) * sizeof(*accumulators_));
    }
  }

  // Returns the index in the rectangle of the first sample of pixel (x, row) of the part.
  size_t FirstSample(int32_t x, int32_t row) const {
    return 3 * static_cast<size_t>((rect_.y + row) * job_.rect.width + rect_.x + x);
  }

  size_t Columns(int32_t x) const {
    return static_cast<size_t>(Min(simd::kStripColumns, rect_.width - x));
  }

  const RenderJob& job_;
  const SliceStack& stack_;
  const CompositorScratch& scratch_;
  const Rect rect_;               // part of the bucket, in pixels of the rectangle to refocus
  uint32_t* const accumulators_;  // accumulators of the rectangle
  SlicePlane planes_[kMaxSlices];
  int32_t pairs_ = 0;
};

void CountSurfaces(const LayeredDepth& surfaces, starfocus_layer_report* counts) {
  const uint64_t pixels = PixelsIn(surfaces.width, surfaces.height);
  counts->surface_pixels += pixels;
  if (surfaces.repeats) counts->filled_pixels += pixels;
  for (int32_t y = 0; y < surfaces.height; ++y) {
    counts->hidden_pixels += simd::kSliceLanes * CountBits(surfaces.hiding[y]);
  }
}

// Removes the light of hidden surfaces that no view shows. A lamp beside a nearer surface would
// otherwise continue behind it, and become brighter than it is.
void ClearHidden(LayeredDepth* surfaces) {
  const size_t row = static_cast<size_t>(surfaces->stride);
  for (int k = 1; k < simd::kSurfaces; ++k) {
    for (size_t c = 0; c < 3; ++c) {
      std::memset(surfaces->rgb[k] + c * surfaces->plane, 0,
                  row * static_cast<size_t>(surfaces->height) * sizeof(int16_t));
    }
  }
}

// Finds the surfaces of the rectangle and copies the rectangle's centre view to the rows of
// CentreRow. Returns the position of the rectangle in `scratch->surfaces`, in pixels.
Rect LoadSurfaces(const RenderJob& job, CompositorScratch* scratch, uint32_t* accumulators) {
  BlockPixels field;
  field.rgb = scratch->block_rgb;
  field.disparity = scratch->block_disparity;
  LoadBlock(*job.input, job.layer, job.rect, job.border, &field);
  SetThinDisparities(*job.input, &field);
  FindLayeredDepth(*job.input->kernels, *job.input, field, &scratch->surfaces);
  SplitMixedPixels(*job.input, *job.grid, field, &scratch->surfaces);
  const Rect& inner = field.inner;
  const size_t row = 3 * static_cast<size_t>(inner.width);
  for (int32_t y = 0; y < inner.height; ++y) {
    std::memcpy(CentreRow(accumulators + static_cast<size_t>(y) * row, inner.width),
                field.Rgb(inner.x, inner.y + y), row * sizeof(*field.rgb));
  }
  if (job.input->runs != nullptr && job.input->views == 1) {
    ClearHidden(&scratch->surfaces);
  } else {
    InpaintHidden(*job.input->kernels, job.layer, scratch->fill, &scratch->surfaces);
  }
  CountSurfaces(scratch->surfaces, job.counts);
  RemoveFocusRange(job.grid->focus, &scratch->surfaces);
  FindStripRanges(*job.input->kernels, scratch->surfaces);
  return inner;
}

// Finds the slices of a bucket. `bucket` is in pixels of the rectangle to refocus.
void FindStack(const RenderJob& job, const Rect& bucket, const CompositorScratch& scratch,
               SliceStack* stack) {
  const Rect in_surfaces = {stack->inner.x + bucket.x, stack->inner.y + bucket.y, bucket.width,
                            bucket.height};
  stack->count = FindSlices(*job.input->kernels, scratch.surfaces, *job.grid, SliceRuleOf(job),
                            in_surfaces, stack->slices);
  FindOffsets(*job.grid, stack->slices, stack->count, scratch.offsets);
  stack->offsets = scratch.offsets;
}

int32_t RoundUp(int32_t size, int32_t least) { return (size + least - 1) / least * least; }

// Returns the size in bytes of a pool for batches of `columns` x `rows` pixels.
size_t PoolBytes(const SliceStack& stack, int32_t columns, int32_t rows) {
  const auto width = static_cast<size_t>(columns), height = static_cast<size_t>(rows);
  size_t slices = 0, strips = 0, filtered = 0;
  for (int32_t k = 0; k < stack.count; ++k) {
    SlicePlane placed;
    PlaceSlice(*stack.grid, stack.slices[k].disparity, {0, 0, 0, 0}, &placed);
    const auto reach = static_cast<size_t>(placed.reach);
    slices += SliceBytes(width, height, reach);
    strips += StripBytes(height, reach);
    filtered = Max(filtered, FilteredBytes(width, reach));
  }
  return slices + Max(filtered, strips);
}

// Returns the largest size of batches whose slices fit into the pool. The function first
// maximises the width of the parts, then the height.
Rect ChooseBatch(const SliceStack& stack, const Rect& bucket, size_t pool_bytes) {
  int32_t width = RoundUp(bucket.width, kLeastColumns), height = RoundUp(bucket.height, kLeastRows);
  while (width > kLeastColumns && PoolBytes(stack, width, kLeastRows) > pool_bytes) {
    width -= kLeastColumns;
  }
  while (height > kLeastRows && PoolBytes(stack, width, height) > pool_bytes) height -= kLeastRows;
  return {0, 0, width, height};
}

// Composites the slices of a bucket. Returns the number of pixels rendered in each view, summed
// over all slices.
uint64_t CompositeBucket(const RenderJob& job, const SliceStack& stack,
                         const CompositorScratch& scratch, const Rect& bucket,
                         uint32_t* accumulators) {
  const Rect largest = ChooseBatch(stack, bucket, scratch.pool_bytes);
  uint64_t pixels = 0;
  for (int32_t y = 0; y < bucket.height; y += largest.height) {
    for (int32_t x = 0; x < bucket.width && GoesOn(job.cancel, 0); x += largest.width) {
      const Rect part = {bucket.x + x, bucket.y + y, Min(largest.width, bucket.width - x),
                         Min(largest.height, bucket.height - y)};
      pixels += Batch(job, stack, scratch, part, accumulators).Refocus();
    }
  }
  return pixels;
}

}  // namespace

SliceRule SliceRuleOf(const RenderJob& job) {
  SliceRule rule = job.is_benchmark ? kFineSlices : kSlices;
  rule.area = MostSliceArea(job.r_max);
  return rule;
}

uint64_t CompositeRectangle(const RenderJob& given, RendererScratch* scratch,
                            uint32_t* accumulators) {
  CompositorScratch& memory = *static_cast<CompositorScratch*>(scratch);
  SliceStack stack;
  stack.inner = LoadSurfaces(given, &memory, accumulators);
  // The surfaces and their slices have disparities without the range in focus.
  ViewGrid grid = *given.grid;
  grid.focus.near = grid.focus.far;
  RenderJob job = given;
  job.grid = &grid;
  stack.grid = &grid;
  ScaleWeights(&stack);
  uint64_t pixels = 0;
  Rect bucket = {0, 0, 0, 0};
  for (; bucket.y < job.rect.height; bucket.y += bucket.height) {
    bucket.height = SideOfBucket(job.rect.height - bucket.y);
    for (bucket.x = 0; bucket.x < job.rect.width; bucket.x += bucket.width) {
      bucket.width = SideOfBucket(job.rect.width - bucket.x);
      if (!GoesOn(job.cancel, 0)) return 3 * pixels;
      FindStack(job, bucket, memory, &stack);
      pixels += CompositeBucket(job, stack, memory, bucket, accumulators);
    }
  }
  return 3 * pixels;
}

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
  const Rect field = Extended(rect, border);
  const auto all = static_cast<uint64_t>(aperture.views) - 1;
  const uint64_t along_axis = 2 * static_cast<uint64_t>(aperture.last);
  const uint64_t columns = all > 0 ? along_axis + 1 : 0;
  BlockWork work = {};
  work.field = PixelsIn(field.width, field.height);
  work.a = columns * PixelsIn(rect.width, field.height);
  work.c = (all - along_axis) * PixelsIn(rect.width, rect.height);
  AddScans(columns, field.height, content[0], layer, &work);
  AddScans(all - along_axis, rect.width, content[1], layer, &work);
  return work;
}

// Allocates the memory of all data that is computed from a field before the slices of a bucket are
// made. The memory for filling the surfaces overlaps the memory of the field.
void TakeField(size_t extended, Arena* arena, CompositorScratch* stack) {
  CompositorScratch& scratch = *stack;
  LayeredDepth& surfaces = scratch.surfaces;
  FillScratch& fill = scratch.fill;
  const size_t row = simd::SliceSamples(extended);
  for (uint16_t*& sources : surfaces.sources) sources = arena->Take<uint16_t>(extended * row);
  const auto take_field = [&] {
    scratch.block_rgb = arena->Take<int16_t>(extended * RgbStride(static_cast<int32_t>(extended)));
    scratch.block_disparity = arena->Take<int16_t>(extended * extended);
    for (uint8_t*& edges : surfaces.edges) {
      edges = arena->Take<uint8_t>(extended * row + simd::kSliceLanes);
    }
    surfaces.moved = arena->Take<int16_t>(row);
    surfaces.behind = arena->Take<int16_t>(row);
    surfaces.steps = arena->Take<simd::StepBits>(row / simd::kSliceLanes);
    surfaces.bins = arena->Take<uint8_t>(kSliceBins);
    surfaces.least_blur = arena->Take<int32_t>(extended);
  };
  const auto take_fill = [&] {
    const size_t stride = FillStride(extended), behind = kFillStep;
    fill.disparity = arena->Take<int16_t>(extended * stride + behind);
    fill.rgb = arena->Take<int16_t>(3 * extended * stride + behind);
    fill.saved = arena->Take<int16_t>(3 * size_t{kFillStep + 1} * stride + behind);
    fill.source = arena->Take<uint16_t>(extended * stride);
    fill.farthest = arena->Take<uint8_t>(extended);
    fill.strips = arena->Take<uint64_t>(extended);
  };
  arena->Overlap(take_field, take_fill);
}

// Allocates the scratch memory of one worker; see Renderer::take_scratch.
void TakeScratch(const FullConfig& config, size_t extended, size_t max_n, Arena* arena,
                 RendererScratch* memory) {
  CompositorScratch counted;
  CompositorScratch& scratch =
      memory == nullptr ? counted : *static_cast<CompositorScratch*>(memory);
  LayeredDepth& surfaces = scratch.surfaces;
  const size_t area = extended * simd::SliceSamples(extended) + simd::kSliceLanes;
  for (int k = 0; k < simd::kSurfaces; ++k) {
    // FindHidden reads kSliceLanes samples before the first disparity, and InsertCopies one before
    // the first colour. Both ignore their values.
    const auto take = [&](size_t samples) {
      int16_t* const before = arena->Take<int16_t>(simd::kSliceLanes + samples);
      return before == nullptr ? nullptr : before + simd::kSliceLanes;
    };
    surfaces.disparity[k] = take(area);
    surfaces.rgb[k] = take(3 * area);
    surfaces.ranges[k] = arena->Take<simd::DisparityRange>(RangeCount(extended));
  }
  surfaces.share = arena->Take<uint8_t>(area);
  surfaces.hiding = arena->Take<uint64_t>(extended);
  scratch.offsets = arena->Take<simd::SliceOffset>(kMaxSlices * (2 * max_n + 1));
  scratch.pairs = arena->Take<CellPair>(CellPairs(config.superblock));
  const auto rows = static_cast<size_t>(LargestBucket(config.superblock));
  scratch.sums = arena->Take<uint32_t>(kPixelSums * simd::kSliceLanes * rows);
  const auto take_pool = [&] {
    // Memory for batches of a bucket of up to 64x64 pixels. With this size, the engine executes 1.7
    // % fewer instructions than with smaller parts.
    const auto bucket = static_cast<size_t>(Min(config.superblock, kBucket));
    const size_t pool = Max(LeastPool(config.max_blur), 119 * bucket * bucket);
    scratch.pool_bytes = Max(pool, arena->Rest());
    scratch.pool = arena->Take<uint8_t>(scratch.pool_bytes);
  };
  arena->Overlap([&] { TakeField(extended, arena, &scratch); }, take_pool);
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
