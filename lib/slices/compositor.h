// SPDX-License-Identifier: Apache-2.0
// The primitive of subapertures: one rectangle of the picture refocused, tile by tile, as a stack
// of slices, which each view of the aperture shows moved against each other, the nearer in front of
// the farther.
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

// Memory of one worker. E: largest side of an extended rectangle; N; G: the smaller of 2 N + 1 and
// kGroupViews. What slices are cut from is made of the field, and they are made of surfaces when
// the field is no longer needed: the pool may share its memory. So may `bins` and `least_blur`,
// which each tile makes anew when the slices of the one before are no longer needed.
struct CompositorScratch {
  int16_t* field_rgb;          // light: E rows of RgbStride(E)
  int16_t* field_disparity;    // E^2
  LayeredDepth surfaces;       // E^2 each
  FillScratch fill;            // of the surfaces; the field is no longer needed
  uint8_t* bins;               // kSliceBins
  int32_t* least_blur;         // E
  simd::SliceOffset* offsets;  // kMaxSlices (2 N + 1)
  int16_t* weights;            // G
  CellPair* pairs;             // of a tile
  uint32_t* sums;              // kPixelSums of the pixels of a strip
  uint8_t* pool;               // slices of a part of a tile, their covers, and what LeastPool says
  size_t pool_bytes;           // at least LeastPool; with more, parts are larger
};

// The most bytes that a slice of the least part and its strip take for each pixel of SliceArea.
inline constexpr size_t kAreaBytes = 33;

// The least bytes of a pool: slices of the least part and their strips, for blur radii up to
// `max_blur`. A plane is filtered where the strips are afterwards, and may take more than the strip
// of one slice.
constexpr size_t LeastPool(double max_blur) {
  const auto reach = static_cast<size_t>(LargestSliceReach(max_blur));
  const size_t filtered = FilteredBytes(kLeastColumns, kLeastRows, reach);
  const size_t strip = StripBytes(kLeastRows, reach);
  return kAreaBytes * static_cast<size_t>(MostSliceArea(max_blur)) +
         (filtered > strip ? filtered - strip : 0);
}

// How many pairs of cells the largest tile of rectangles up to `side` has.
constexpr size_t CellPairs(int32_t side) {
  constexpr size_t kRows = kLeastRows;
  const auto rows = static_cast<size_t>(LargestTile(side));
  return (rows + kRows - 1) / kRows * (simd::SliceSamples(rows) / simd::kSliceLanes);
}

// Fractional bits of what CompositeRectangle sums.
inline constexpr int kCompositeBits = kMaxLightBits + kLightBits;

// Renderer::render of slices: each tile of the rectangle has slices of its own, and the samples of
// all slices count. `scratch`: a CompositorScratch.
uint64_t CompositeRectangle(const RenderJob& job, void* scratch, uint32_t* accumulators);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_COMPOSITOR_H_
