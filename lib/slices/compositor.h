// SPDX-License-Identifier: Apache-2.0
// The compositor of the slice renderer. The compositor refocuses one rectangle of the picture, tile
// by tile. The compositor represents each tile by a stack of slices. To render a view, the
// compositor shifts each slice according to the slice's disparity, and composites the slices front
// to back, strip by strip (strip.cc).
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

// Largest number of views of a column that are summed together in 16 bits. If more views were
// summed together, each weight would be smaller, and the products of small weights and faint light
// would round to zero.
inline constexpr int32_t kGroupViews = 16;

// Weights of views in the units of the SIMD kernels: aperture weights times scale / 2^16. If the
// weights of a group exceed the limit of the SIMD kernels, the compositor adds the group in several
// shares.
struct ScaledWeights {
  const ViewWeights* aperture;
  uint64_t scale;    // Factor of the aperture weights, times 2^16 (21 bits).
  uint32_t largest;  // Largest weight of the aperture.
  // Smallest sum of coverage from which a colour is computed. If a colour were computed from a
  // smaller sum of coverage, rounding errors of the colour would be visible.
  uint32_t least_covered;

  // Returns share `share` of the weight, which is divided into `shares` equal shares.
  int16_t Weight(int32_t i, int32_t j, int extra_bits, uint32_t share, uint32_t shares) const {
    const uint64_t weight = (aperture->Weight(i, j) * (scale << extra_bits)) >> 16;
    return static_cast<int16_t>(weight * (share + 1) / shares - weight * share / shares);
  }

  // Returns the number of equal shares into which the weights of views (i, first) to (i, last) must
  // be divided.
  uint32_t Shares(int32_t i, int32_t first, int32_t last) const;

  // Returns the largest j <= last for which all weights of views (i, first) to (i, j) have the same
  // magnitude. The magnitude of a weight is the number of times that the weight can be multiplied
  // by sixteen without exceeding the largest weight. In apertures with a steep fall-off, outer
  // views weigh much less than the middle view. If the compositor summed outer views together with
  // the middle view, the products of outer weights with faint light would round to zero.
  int32_t LastAlike(int32_t i, int32_t first, int32_t last) const;

  // Returns the number of bits by which the scaled weights of views (i, first) to (i, last) are
  // shifted left. If a whole column fits in one group, the result is 0 unless the weight of view
  // (i, first) is at most 1/16 of the largest weight of the aperture.
  int ExtraBits(int32_t i, int32_t first, int32_t last) const;

  // Returns the largest j for which the aperture has a view (i, j).
  int32_t LastAcross(int32_t i) const {
    int32_t j = aperture->last;
    while (i * i + j * j > aperture->most) --j;
    return j;
  }
};

// Scales the weights of an aperture so that each group's weights sum to at most kGroupSum and each
// weight is at most kGroupSum / 4. For apertures with a steep fall-off, the limits kGroupSum and
// kGroupSum / 4 are multiplied by the number of shares, which is at most kMostShares.
ScaledWeights ScaleWeights(const ViewWeights& aperture);

// The stack of slices of a tile, ordered from the nearest to the farthest.
struct SliceStack {
  const ViewGrid* grid;
  ScaledWeights weights;
  Rect inner;  // rectangle to refocus, which contains the tile, in pixels of the surfaces
  int32_t count;
  Slice slices[kMaxSlices];
  simd::DisparityRange bands[kMaxBands];  // Disparities of all surfaces in each band.
  const simd::SliceOffset* offsets;       // One offset per slice, for each column -N to N of views.

  // Returns the offset of slice k along x in all views (i, j), which is also the offset along y in
  // all views (j, i).
  const simd::SliceOffset& Offset(int32_t k, int32_t i) const {
    return offsets[(i + grid->n()) * count + k];
  }
};

// Two adjacent cells (squares of up to 8x8 pixels), with the slices that are visible in these
// cells.
struct CellPair {
  int32_t x, y, rows;  // Position in the part of the tile, and height, both in pixels.
  int32_t count;       // Number of slices that are visible in the two cells.
  uint8_t shown[kMaxSlices];
};

// Sums of a pixel: R, G, B and coverage.
inline constexpr size_t kPixelSums = 4;

// Writes the sums over all views of the cell pairs [first, end), which lie at one column of a part
// of a tile, to `sums`: kPixelSums per pixel, in the order of rows. There is at least one pair.
// `planes` has one plane per slice, filled for the part of the tile. `memory` is scratch memory of
// StripBytes for each slice. `cancel` may be null.
void CompositeStrip(const simd::Kernels& kernels, const SliceStack& stack, const SlicePlane* planes,
                    const CellPair* first, const CellPair* end, int16_t* memory, uint32_t* sums,
                    CancelToken* cancel);

// Returns a pointer to the sums of row `row` in the buffer `sums` of CompositeStrip.
inline uint32_t* SumsOfRow(uint32_t* sums, int32_t row) {
  return sums + kPixelSums * simd::kSliceLanes * static_cast<size_t>(row);
}

// Scratch memory of one worker. E is the largest side of an extended rectangle, and N is the
// largest number of views along the aperture radius.
//
// Members with disjoint lifetimes share memory. `fill` reuses the memory of the field. `pool` may
// reuse the memory of the field, `fill` and the scratch memory of FindSlices in `surfaces`, which
// each tile writes before its slices are made.
struct CompositorScratch : RendererScratch {
  // Pixels of the block: E rows of RgbStride(E) samples of light, and E^2 disparities.
  int16_t *field_rgb, *field_disparity;
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
