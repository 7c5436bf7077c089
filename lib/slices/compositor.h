// SPDX-License-Identifier: Apache-2.0
// The compositor of the slice renderer. The compositor refocuses one rectangle of the picture,
// bucket by bucket. The compositor represents each bucket by a stack of slices. To render a view,
// the compositor shifts each slice according to the slice's disparity, and composites the slices
// front to back, strip by strip (strip.cc).
#ifndef STARFOCUS_LIB_SLICES_COMPOSITOR_H_
#define STARFOCUS_LIB_SLICES_COMPOSITOR_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/jobs.h"
#include "lib/optics/view_grid.h"
#include "lib/plan/renderer.h"
#include "lib/slices/inpaint.h"
#include "lib/slices/layered_depth.h"
#include "lib/slices/slice_plane.h"
#include "simd/kernels.h"

namespace starfocus {

// The stack of slices of a bucket, ordered from the nearest to the farthest.
struct SliceStack {
  const ViewGrid* grid;
  // The weights of views in the units of the SIMD kernels are aperture weights times weight_scale /
  // 2^16.
  uint64_t weight_scale;    // 21 bits
  uint32_t largest_weight;  // largest weight of the aperture
  // Smallest sum of coverage from which a colour is computed. If a colour were computed from a
  // smaller sum of coverage, rounding errors of the colour would be visible.
  uint32_t least_covered;
  Rect inner;  // rectangle to refocus, which contains the bucket, in pixels of the surfaces
  int32_t count;
  Slice slices[kMaxSlices];
  const simd::SliceOffset* offsets;  // One offset per slice, for each column -N to N of views.

  // Returns the offset of slice k along x in all views (i, j), which is also the offset along y in
  // all views (j, i).
  const simd::SliceOffset& Offset(int32_t k, int32_t i) const {
    return offsets[(i + grid->n()) * count + k];
  }
};

// Scales the weights of the stack's aperture so that the weights of each group of views sum to at
// most kGroupSum and each weight is at most kGroupSum / 4. For apertures with a steep fall-off,
// both limits are multiplied by the number of portions in which the compositor adds a group, which
// is at most kMostPortions.
void ScaleWeights(SliceStack* stack);

// Two adjacent cells (squares of up to 8x8 pixels), with the slices that are visible in these
// cells.
struct CellPair {
  int32_t x, y, rows;  // Position in the part of the bucket, and height, both in pixels.
  int32_t count;       // Number of slices that are visible in the two cells.
  uint8_t shown[kMaxSlices];
};

// Sums of a pixel: R, G, B and coverage.
inline constexpr size_t kPixelSums = 4;

// Writes the sums over all views of the cell pairs [first, end), which lie at one column of a part
// of a bucket, to `sums`: kPixelSums per pixel, in the order of rows. There is at least one pair.
// `planes` has one plane per slice, filled for the part of the bucket. `memory` is scratch memory
// of StripBytes for each slice. `cancel` may be null. Returns the number of pixels of slices that
// were shifted.
uint64_t CompositeStrip(const simd::Kernels& kernels, const SliceStack& stack,
                        const SlicePlane* planes, const CellPair* first, const CellPair* end,
                        int16_t* memory, uint32_t* sums, CancelToken* cancel);

// Returns a pointer to the sums of row `row` in the buffer `sums` of CompositeStrip.
inline uint32_t* SumsOfRow(uint32_t* sums, int32_t row) {
  return sums + kPixelSums * simd::kSliceLanes * static_cast<size_t>(row);
}

// Scratch memory of one worker. E is the largest side of an extended rectangle, and N is the
// largest number of views along the aperture radius.
//
// Members with disjoint lifetimes portion memory. `fill` reuses the memory of the field. `pool` may
// reuse the memory of the field, `fill` and the scratch memory of FindSlices in `surfaces`, which
// each bucket writes before its slices are made.
struct CompositorScratch : RendererScratch {
  // Pixels of the block: E rows of RgbStride(E) samples of light, and E^2 disparities.
  int16_t *block_rgb, *block_disparity;
  LayeredDepth surfaces;       // E^2 pixels per surface.
  FillScratch fill;            // Used only after all reads of the field.
  simd::SliceOffset* offsets;  // kMaxSlices (2 N + 1) elements.
  CellPair* pairs;             // Cell pairs of a bucket.
  uint32_t* sums;              // kPixelSums per pixel of a strip.
  uint8_t* pool;               // Slices of a batch of a bucket, and the strips of these slices.
  size_t pool_bytes;           // At least LeastPool; a larger pool allows larger parts.
};

// Upper bound of the memory for a slice of the smallest batch and for the slice's strip, in
// bytes per pixel of SliceArea.
inline constexpr size_t kAreaBytes = 33;

// Returns the smallest permitted size of the pool in bytes. The pool must hold the slices of the
// smallest batch and the strips of these slices, for blur radii up to `max_blur` pixels. The
// filter of a slice uses the memory of the strips, and may require more memory than the strip of
// one slice.
constexpr size_t LeastPool(double max_blur) {
  const auto reach = static_cast<size_t>(LargestSliceReach(max_blur));
  const size_t filtered = FilteredBytes(kLeastColumns, reach);
  const size_t strip = StripBytes(kLeastRows, reach);
  return kAreaBytes * static_cast<size_t>(MostSliceArea(max_blur)) +
         (filtered > strip ? filtered - strip : 0);
}

// Returns the number of pairs of cells in the largest bucket of rectangles up to `side`.
constexpr size_t CellPairs(int32_t side) {
  constexpr size_t kRows = kLeastRows;
  const auto rows = static_cast<size_t>(LargestBucket(side));
  return (rows + kRows - 1) / kRows * (simd::SliceSamples(rows) / simd::kSliceLanes);
}

// Fractional bits of the sums of CompositeRectangle.
inline constexpr int kCompositeBits = kMaxLightBits + kLightBits;

// Returns the limits on the slices of a bucket of the job's rectangle.
SliceRule SliceRuleOf(const RenderJob& job);

// Implements Renderer::render for slices. Each bucket of the rectangle has its own slices. Returns
// the number of samples rendered in each view (three per pixel), summed over all slices. `scratch`
// is a CompositorScratch.
uint64_t CompositeRectangle(const RenderJob& job, RendererScratch* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_COMPOSITOR_H_
