// SPDX-License-Identifier: Apache-2.0
// The compositor of the slice renderer. It refocuses one rectangle of the picture, tile by tile.
// Each tile is a stack of slices; every view of the aperture shows the slices shifted by their
// disparity and composited front to back.
#ifndef STARFOCUS_LIB_SLICES_COMPOSITOR_H_
#define STARFOCUS_LIB_SLICES_COMPOSITOR_H_

#include <cstddef>
#include <cstdint>

#include "lib/plan/renderer.h"
#include "lib/slices/depth_slices.h"
#include "lib/slices/hidden_fill.h"
#include "lib/slices/slice_plane.h"
#include "lib/slices/strip.h"

namespace starfocus {

// Scratch memory of one worker. E is the largest side of an extended rectangle, N the largest N,
// and G the smaller of 2 N + 1 and kGroupViews.
//
// The members share memory where their lifetimes allow it. `fill` reuses the memory of the field.
// `pool` may reuse the memory of both, and that of `bins` and `least_blur`, which each tile writes
// before it makes slices.
struct CompositorScratch {
  int16_t* field_rgb;          // light: E rows of RgbStride(E) samples
  int16_t* field_disparity;    // E^2
  LayeredDepth surfaces;       // E^2 pixels each
  FillScratch fill;            // used when the field is no longer needed
  uint8_t* bins;               // kSliceBins
  int32_t* least_blur;         // E
  simd::SliceOffset* offsets;  // kMaxSlices (2 N + 1)
  int16_t* weights;            // G
  CellPair* pairs;             // pairs of cells of a tile
  uint32_t* sums;              // kPixelSums per pixel of a strip
  uint8_t* pool;               // slices of a part of a tile, and their strips
  size_t pool_bytes;           // at least LeastPool; a larger pool makes larger parts
};

// Upper bound of the bytes that a slice of the smallest part, with its strip, needs per pixel of
// SliceArea.
inline constexpr size_t kAreaBytes = 33;

// Returns the smallest size of a pool in bytes. It holds the slices of the smallest part and their
// strips, for blur radii up to `max_blur`. Filtering a plane uses the memory of the strips, and may
// need more than the strip of one slice.
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

// Implements Renderer::render for slices. Each tile of the rectangle has its own slices. Returns
// the number of samples summed over all slices. `scratch` is a CompositorScratch.
uint64_t CompositeRectangle(const RenderJob& job, void* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_COMPOSITOR_H_
