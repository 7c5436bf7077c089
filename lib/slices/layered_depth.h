// SPDX-License-Identifier: Apache-2.0
// The layered depth image of a field. Surface 0 is the surface that the centre view sees. Up to
// two hidden surfaces lie behind depth edges; captured views that see these surfaces provide the
// colours. The compositor divides the surfaces into slices.
#ifndef STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
#define STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/fixed.h"
#include "lib/io/block_pixels.h"
#include "lib/io/input.h"
#include "lib/optics/view_grid.h"
#include "simd/kernels.h"

namespace starfocus {

using simd::kNoSurface;

// Smallest and largest step of disparity between neighbouring pixels of layer 0 at which a surface
// is closed. The slices on both sides of a step in this range move apart, so the pixel on the far
// side is continued behind the pixel on the near side by a copy of itself. Without the copy,
// background would show in the gap (docs/constants.md). Larger steps are depth edges.
inline constexpr int16_t kLeastCopy = 2, kMostCopy = kDepthEdge;

// Largest width of surfaces, in strips of kSliceLanes columns.
inline constexpr int32_t kMaxStrips = 64;

// Number of rows that have one range of disparities in each strip.
inline constexpr int32_t kRangeRows = 8;

// Returns the number of ranges of a surface with up to `side` columns and rows.
constexpr size_t RangeCount(size_t side) {
  constexpr auto kRows = static_cast<size_t>(kRangeRows);
  return (side + kRows - 1) / kRows * (simd::SliceSamples(side) / simd::kSliceLanes);
}

// The surfaces of a field. Surface 0, the nearest surface, is a copy of the field. Each surface
// consists of rows of `stride` pixels, followed by kSliceLanes more pixels. Colours are in three
// planes, `plane` samples apart.
struct LayeredDepth {
  int32_t width = 0, height = 0, stride = 0;
  size_t plane = 0;
  int16_t* disparity[simd::kSurfaces] = {};  // kDisparityBits.
  int16_t* rgb[simd::kSurfaces] = {};        // Light.
  // Share of each pixel that surface 0 covers, in kSliceBits, or kSliceEnd where surface 0 ends.
  uint8_t* share = nullptr;
  int16_t low = 0, high = 0;  // range of the disparities of the field
  // Distances in pixels from each pixel to the far side of a depth edge to the right, left, bottom
  // and top. The pixel hides a surface that continues behind the edge. A distance of 0 means that
  // the pixel hides no surface on that side.
  uint8_t* edges[4] = {};
  int16_t *moved = nullptr, *behind = nullptr;  // Scratch memory of FindEdges: one row each.
  simd::StepBits* steps = nullptr;              // Scratch memory of FindSteps: one row.
  // Scratch memory of FindSlices: kSliceBins elements, and one element per pixel of the larger
  // side.
  uint8_t* bins = nullptr;
  int32_t* least_blur = nullptr;
  // Source of the colour of each pixel of the hidden surfaces, in the format of FindHidden. The
  // sources are valid only in strips whose bit in `hiding` is set.
  uint16_t* sources[simd::kSurfaces - 1] = {};
  bool repeats = false;        // True if the colour of any pixel is repeated.
  uint64_t* hiding = nullptr;  // One element per row: bit k is set if strip k has a hidden surface.
  // Range of the disparities of each surface in each strip, over kRangeRows rows: RangesAt.
  simd::DisparityRange* ranges[simd::kSurfaces] = {};

  size_t At(int32_t x, int32_t y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(stride) + static_cast<size_t>(x);
  }

  // Returns the ranges of a surface in the strips of row y, from the strip of column x on.
  simd::DisparityRange* RangesAt(int surface, int32_t x, int32_t y) const {
    return ranges[surface] + At(x, y / kRangeRows) / simd::kSliceLanes;
  }
};

// Extends *all to include `range`.
inline void Widen(const simd::DisparityRange& range, simd::DisparityRange* all) {
  all->low = range.low < all->low ? range.low : all->low;
  all->high = range.high > all->high ? range.high : all->high;
}

// Finds the surfaces of a field. The caller sets the pointers of `surfaces` to sufficient memory.
//
// The surfaces behind a pixel are found along its row and its column. On each side, the search
// covers the surfaces beyond the next two depth edges, as far as a view at distance 1 can see. At
// most two hidden surfaces are kept for each pixel; the surface beyond the nearest edge comes
// first.
//
// The colours of a hidden surface are read from a captured view that looks behind the edge
// (OcclusionViews) and in which nothing covers the surface. If no view sees the surface, the colour
// of the background beyond the edge is repeated. If several sides provide a surface of the same
// disparity at the same distance, their colours are averaged. At steps within a surface, each pixel
// on the near side hides a copy of the farthest of its eight neighbours (kMostCopy).
void FindLayeredDepth(const simd::Kernels& kernels, const Input& input, const BlockPixels& field,
                      LayeredDepth* surfaces);

// Splits the mixed pixels of a field (SplitPixel) into both surfaces: the nearer surface covers its
// share of the pixel, and the far surface lies behind the nearer surface with its own colour. The
// caller must call this function after FindLayeredDepth and before InpaintHidden. If a split
// pixel would have four surfaces, the farthest surface is dropped.
void SplitMixedPixels(const Input& input, const ViewGrid& grid, const BlockPixels& field,
                      LayeredDepth* surfaces);

// Replaces the disparities of all surfaces by disparities without the range
// (FocusRange::WithoutRange), so that the surfaces inside the range in focus belong to one slice.
// Within a slice, the nearer surface of a pixel covers the farther ones. The captured views show
// surfaces at their original disparities, so this is the last step.
void RemoveFocusRange(const FocusRange& focus, LayeredDepth* surfaces);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_LAYERED_DEPTH_H_
