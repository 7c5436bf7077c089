// SPDX-License-Identifier: Apache-2.0
// The compositor of the slice renderer. The compositor refocuses one rectangle of the picture, tile
// by tile. The compositor represents each tile by a stack of slices. To render a view, the
// compositor shifts each slice according to the slice's disparity, and composites the slices front
// to back.
#ifndef STARFOCUS_LIB_SLICES_COMPOSITOR_H_
#define STARFOCUS_LIB_SLICES_COMPOSITOR_H_

#include <cstddef>
#include <cstdint>

#include "lib/plan/renderer.h"
#include "lib/slices/inpaint.h"
#include "lib/slices/slice_plane.h"
#include "lib/slices/slices.h"
#include "lib/slices/strip.h"

namespace starfocus {

// Scratch memory of one worker. E is the largest side of an extended rectangle, and N is the
// largest number of views along the aperture radius.
//
// Members with disjoint lifetimes share memory. `fill` reuses the memory of the field. `pool` may
// reuse the memory of the field, `fill` and the scratch memory of FindSlices in `surfaces`, which
// each tile writes before its slices are made.
struct CompositorScratch : RendererScratch {
  BlockPixels field;           // E rows of RgbStride(E) samples of light, and E^2 disparities.
  LayeredDepth surfaces;       // E^2 pixels per surface.
  FillScratch fill;            // Used only after all reads of the field.
  simd::SliceOffset* offsets;  // kMaxSlices (2 N + 1) elements.
  CellPair* pairs;             // Cell pairs of a tile.
  uint32_t* sums;              // kPixelSums per pixel of a strip.
  uint8_t* pool;               // Slices of a part of a tile, and the strips of these slices.
  size_t pool_bytes;           // At least LeastPool; a larger pool allows larger parts.
};

// Upper bound of the memory for a slice of the smallest tile part and for the slice's strip, in
// bytes per pixel of SliceArea.
inline constexpr size_t kAreaBytes = 33;

// Returns the smallest permitted size of the pool in bytes. The pool must hold the slices of the
// smallest tile part and the strips of these slices, for blur radii up to `max_blur` pixels. The
// filter of a plane uses the memory of the strips, and may require more memory than the strip of
// one slice.
constexpr size_t LeastPool(double max_blur) {
  const auto reach = static_cast<size_t>(LargestSliceReach(max_blur));
  const size_t filtered = FilteredBytes(kLeastColumns, kLeastRows, reach);
  const size_t strip = StripBytes(kLeastRows, reach);
  return kAreaBytes * static_cast<size_t>(MostSliceArea(max_blur)) +
         (filtered > strip ? filtered - strip : 0);
}

// Returns the number of pairs of cells in the largest tile of rectangles up to `side`.
constexpr size_t CellPairs(int32_t side) {
  constexpr size_t kRows = kLeastRows;
  const auto rows = static_cast<size_t>(LargestTile(side));
  return (rows + kRows - 1) / kRows * (simd::SliceSamples(rows) / simd::kSliceLanes);
}

// Fractional bits of the sums of CompositeRectangle.
inline constexpr int kCompositeBits = kMaxLightBits + kLightBits;

// Returns the limits on the slices of a tile of the job's rectangle.
SliceRule SliceRuleOf(const RenderJob& job);

// Implements Renderer::render for slices. Each tile of the rectangle has its own slices. Returns
// the number of samples rendered in each view (three per pixel), summed over all slices. `scratch`
// is a CompositorScratch.
uint64_t CompositeRectangle(const RenderJob& job, RendererScratch* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_COMPOSITOR_H_
