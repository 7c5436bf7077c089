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
// largest number of views along the aperture radius. G is the smaller of 2 N + 1 and kGroupViews.
//
// Members with disjoint lifetimes share memory. `fill` reuses the memory of the field. `pool` may
// reuse the memory of the field, `fill`, `bins` and `least_blur`; each tile writes `bins` and
// `least_blur` before its slices are made.
struct CompositorScratch {
  int16_t* field_rgb;          // Colours of the field as light: E rows of RgbStride(E) samples.
  int16_t* field_disparity;    // Disparities of the field: E^2.
  LayeredDepth surfaces;       // E^2 pixels per surface.
  FillScratch fill;            // Used only after all reads of the field.
  uint8_t* bins;               // kSliceBins elements.
  int32_t* least_blur;         // E elements.
  simd::SliceOffset* offsets;  // kMaxSlices (2 N + 1) elements.
  int16_t* weights;            // G elements.
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

// Returns the job that finds the slices of a tile. `tile` is in pixels of scratch.surfaces, which
// must contain the surfaces of the job's rectangle.
SliceJob SlicesOfTile(const RenderJob& job, const Rect& tile, const CompositorScratch& scratch);

// Implements Renderer::render for slices. Each tile of the rectangle has its own slices. Returns
// the number of samples rendered in each view (three per pixel), summed over all slices. `scratch`
// is a CompositorScratch.
uint64_t CompositeRectangle(const RenderJob& job, void* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_COMPOSITOR_H_
