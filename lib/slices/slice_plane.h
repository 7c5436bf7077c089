// SPDX-License-Identifier: Apache-2.0
// A slice of a part of a tile in memory: its pixels and the surrounding pixels that some view
// shows. Wide subapertures are already applied as a filter. Also the position of the slice in each
// view.
#ifndef STARFOCUS_LIB_SLICES_SLICE_PLANE_H_
#define STARFOCUS_LIB_SLICES_SLICE_PLANE_H_

#include <cstddef>
#include <cstdint>

#include "lib/base/geometry.h"
#include "lib/base/view_grid.h"
#include "lib/slices/layered_depth.h"
#include "lib/slices/slice.h"
#include "simd/kernels.h"

namespace starfocus {

// Largest subaperture, three pixels, that is a box over up to four pixels (kShiftBits). Wider
// subapertures are a filter before the shift; the blur that interpolation adds to these is small.
inline constexpr int32_t kBoxSubaperture = 3 * kShiftOne;

// Returns the number of pixels on each side to which a wider subaperture spreads a pixel.
constexpr int32_t SpreadReach(int32_t subaperture) {
  static_assert(simd::kMaxSpread == 3, "wider boxes are cut off");
  return subaperture <= kBoxSubaperture ? 0 : subaperture <= 5 * kShiftOne ? 2 : simd::kMaxSpread;
}

// Returns the number of pixels beyond the rectangle that a slice of blur radius `rim` needs (both
// kShiftBits). It is the blur radius, rounded up, plus the reach of filters, boxes and
// interpolation.
constexpr int32_t SliceReach(int32_t rim, int32_t subaperture) {
  const bool is_box = subaperture > kShiftOne && subaperture <= kBoxSubaperture;
  return ((rim + kShiftOne - 1) >> kShiftBits) + (is_box ? 2 : SpreadReach(subaperture) + 1);
}

// Slices of wider subapertures reach no farther than slices of this one.
inline constexpr int32_t kWidestSubaperture = 8 * kShiftOne;

// Returns the largest SliceReach for lenses with blur radii up to `max_blur` pixels, any N and the
// widest subapertures. The blur is increased by the rounding of the focus and of a disparity to
// kDisparityBits. It also includes the distance from the middle of a slice to its pixels: up to two
// steps if bins hold several disparities (kSliceBins).
constexpr int32_t LargestSliceReach(double max_blur) {
  constexpr double kRounding = 4.0 / (1 << kDisparityBits);
  const double rim = (max_blur + kRounding) * LargestSubapertureExtent() * kShiftOne;
  return SliceReach(static_cast<int32_t>(rim) + 1, kWidestSubaperture);
}

// Returns the area that a slice counts for. It is a measure of the memory and the time that the
// slice needs. `reach` is the number of pixels that the slice extends beyond a small part of a
// tile.
constexpr int32_t SliceArea(int32_t reach) { return (reach + 16) * (reach + 16); }

// Returns the largest sum of SliceArea over the slices of a tile, for a lens with blur radii up to
// `blur` pixels. It allows five slices of that blur, or of 32 pixels if that is more. The sum
// decides how finely a picture is cut, and therefore its bytes. It depends on the lens alone, not
// on the available memory or on how slices are stored.
constexpr int32_t MostSliceArea(double blur) {
  constexpr int32_t kLeastBlur = 32, kMargin = 3;
  return 5 * SliceArea(Max(static_cast<int32_t>(blur), kLeastBlur) + kMargin);
}

struct SlicePlane {
  int32_t reach = 0;                  // pixels beyond the rectangle
  int32_t rows = 0;                   // rows of the rectangle, plus `reach` above and below it
  size_t plane = 0;                   // samples from plane to plane; a row has four planes
  int32_t subaperture = 0;            // width of a view's subaperture, kShiftBits
  int16_t* samples = nullptr;         // first row
  simd::SliceCover* cover = nullptr;  // of each row
};

// Returns the samples between the planes of a slice that extends `reach` pixels beyond a rectangle.
constexpr size_t PlaneSamples(size_t width, size_t reach) {
  return simd::SliceSamples(simd::SliceSamples(width) + 2 * reach) + simd::kSliceLanes;
}
// Returns the samples of the slice, including those that filters read before and after it.
constexpr size_t SliceSize(size_t width, size_t height, size_t reach) {
  return 4 * (height + 2 * reach) * PlaneSamples(width, reach) + 2 * simd::kSliceLanes;
}

// Returns the rows of the slice in a strip, including those that are read after the last.
constexpr size_t ShiftedRows(size_t height, size_t reach) {
  return height + 2 * reach + simd::kRowsAhead;
}

// Returns the bytes of the covers of these rows, rounded up so that the data after them is aligned
// alike.
constexpr size_t CoverBytes(size_t rows) {
  constexpr size_t kAligned = 4;
  return (rows + kAligned - 1) / kAligned * kAligned * sizeof(simd::SliceCover);
}

// Returns the bytes of a slice with its covers.
constexpr size_t SliceBytes(size_t width, size_t height, size_t reach) {
  return SliceSize(width, height, reach) * sizeof(int16_t) + CoverBytes(height + 2 * reach);
}
// Returns the bytes of one plane of a slice while it is filtered.
constexpr size_t FilteredBytes(size_t width, size_t height, size_t reach) {
  return (height + 2 * reach) * PlaneSamples(width, reach) * sizeof(int16_t);
}
constexpr size_t StripBytes(size_t height, size_t reach) {
  return ShiftedRows(height, reach) * (4 * simd::kSliceLanes * sizeof(int16_t) + 1);
}

// Finds the position in each view, from -N to N, of a slice that moves like `disparity`. The
// results are `stride` elements apart.
void FindOffsets(const ViewGrid& grid, int16_t disparity, size_t stride,
                 simd::SliceOffset* offsets);

// Computes the geometry of the slice around `rect`.
void PlaceSlice(const ViewGrid& grid, int16_t disparity, const Rect& rect, SlicePlane* placed);

// Input from which slices are made.
struct SliceInput {
  const simd::Kernels& kernels;
  const LayeredDepth& surfaces;
  const SurfaceBands& bands;
};

// Copies the slice's pixels around `rect`, which is in pixels of the surfaces. Beyond the surfaces
// their outermost pixels are repeated. For wide subapertures it also spreads the pixels; `filtered`
// has room for the rows of one plane. Bands without a disparity of the slice are skipped. The
// memory of samples and covers must be set.
void FillSlice(const SliceInput& input, const Slice& slice, const Rect& rect, int16_t* filtered,
               const SlicePlane& placed);

// Rows of a slice in a strip of kSliceLanes columns, as a column of views shows them. The four
// planes are `plane` samples apart. Each row has a mark (simd::kNothingNear), and kRowsAhead marks
// precede the first.
struct ShiftedSlice {
  int16_t* samples = nullptr;
  int8_t* near = nullptr;
  size_t plane = 0;
  RowRange filled = {0, 0};  // all other rows are empty in all views
};

// Returns the strips of a row, as bits of SliceCover, that some view shows in the strip at column
// `x`.
constexpr uint64_t StripsOf(const SlicePlane& placed, int32_t x) {
  constexpr auto kStripColumns = static_cast<int32_t>(simd::kSliceLanes);
  const int32_t first = x / kStripColumns,
                last = (x + kStripColumns - 1 + 2 * placed.reach) / kStripColumns;
  return (uint64_t{2} << last) - (uint64_t{1} << first);
}

// Finds the rows of the strip at column `x` of the rectangle that views show in its rows `seen`.
// Clears the other rows that are read with them. The memory must be set.
void PlaceStrip(const SlicePlane& placed, int32_t x, const RowRange& seen, ShiftedSlice* shifted);

// Writes those of `rows` that are filled, moved by `offset`.
void ShiftSlice(const simd::Kernels& kernels, const SlicePlane& placed,
                const simd::SliceOffset& offset, int32_t x, const RowRange& rows,
                const ShiftedSlice& shifted);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_PLANE_H_
