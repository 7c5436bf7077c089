// SPDX-License-Identifier: Apache-2.0
// A slice of a part of a tile in memory: its pixels and those around it that some view shows,
// spread by the subaperture where that is wide, and where each view shows it.
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

// Subapertures up to this wide, three pixels, are boxes of their width on up to four pixels; what
// interpolation adds to wider ones, spread before they are moved, is little. kShiftBits.
inline constexpr int32_t kBoxSubaperture = 3 * kShiftOne;

// Pixels on either side that wider subapertures spread a pixel to.
constexpr int32_t SpreadReach(int32_t subaperture) {
  static_assert(simd::kMaxSpread == 3, "wider boxes are cut off");
  return subaperture <= kBoxSubaperture ? 0 : subaperture <= 5 * kShiftOne ? 2 : simd::kMaxSpread;
}

// Pixels beyond the rectangle that a slice blurred by `rim` (both kShiftBits) is made of: beyond
// the rim, rounded up, those of filters, boxes and interpolation.
constexpr int32_t SliceReach(int32_t rim, int32_t subaperture) {
  const bool is_box = subaperture > kShiftOne && subaperture <= kBoxSubaperture;
  return ((rim + kShiftOne - 1) >> kShiftBits) + (is_box ? 2 : SpreadReach(subaperture) + 1);
}

// Slices of the widest subapertures reach no farther than those of this one.
inline constexpr int32_t kWidestSubaperture = 8 * kShiftOne;

// The most that SliceReach is, for lenses with blur radii up to `max_blur` pixels, any N and the
// widest subapertures. Added to the blur: what rounding the focus and a disparity to kDisparityBits
// does, and the middle of a slice, which lies up to two such steps beyond its pixels where bins
// hold several disparities (kSliceBins).
constexpr int32_t LargestSliceReach(double max_blur) {
  constexpr double kRounding = 4.0 / (1 << kDisparityBits);
  const double rim = (max_blur + kRounding) * LargestSubapertureExtent() * kShiftOne;
  return SliceReach(static_cast<int32_t>(rim) + 1, kWidestSubaperture);
}

// The area that a slice counts for, where `reach` is the pixels that it reaches beyond a small
// part of a tile. It stands for the memory and the time that the slice takes.
constexpr int32_t SliceArea(int32_t reach) { return (reach + 16) * (reach + 16); }

// The most that SliceArea of all slices of a tile may sum to, for a lens with blur radii up to
// `blur` pixels: five slices with that blur, or with one of 32 pixels. It decides how finely a
// picture is cut, and so its bytes. It follows from the lens alone, not from the memory there is or
// from how slices are stored.
constexpr int32_t MostSliceArea(double blur) {
  constexpr int32_t kLeastBlur = 32, kMargin = 3;
  return 5 * SliceArea(Max(static_cast<int32_t>(blur), kLeastBlur) + kMargin);
}

struct SlicePlane {
  int32_t reach = 0;                  // pixels beyond the rectangle
  int32_t rows = 0;                   // the rectangle's, and reach above and below it
  size_t plane = 0;                   // samples from plane to plane; four to the next row
  int32_t subaperture = 0;            // width of a view's, kShiftBits
  int16_t* samples = nullptr;         // of the first row
  simd::SliceCover* cover = nullptr;  // of each row
};

// Samples between the planes of a slice that reaches `reach` pixels beyond a rectangle.
constexpr size_t PlaneSamples(size_t width, size_t reach) {
  return simd::SliceSamples(simd::SliceSamples(width) + 2 * reach) + simd::kSliceLanes;
}
// Samples of it, with what filters read before and behind it.
constexpr size_t SliceSize(size_t width, size_t height, size_t reach) {
  return 4 * (height + 2 * reach) * PlaneSamples(width, reach) + 2 * simd::kSliceLanes;
}

// Rows of it in a strip, with those that are read beyond the last.
constexpr size_t ShiftedRows(size_t height, size_t reach) {
  return height + 2 * reach + simd::kRowsAhead;
}

// Bytes of the covers of its rows, so that what follows them is aligned as they are.
constexpr size_t CoverBytes(size_t rows) {
  constexpr size_t kAligned = 4;
  return (rows + kAligned - 1) / kAligned * kAligned * sizeof(simd::SliceCover);
}

// Bytes of it and its covers, and of it in a strip with the marks of its rows.
constexpr size_t SliceBytes(size_t width, size_t height, size_t reach) {
  return SliceSize(width, height, reach) * sizeof(int16_t) + CoverBytes(height + 2 * reach);
}
// Bytes of a plane of it while it is filtered.
constexpr size_t FilteredBytes(size_t width, size_t height, size_t reach) {
  return (height + 2 * reach) * PlaneSamples(width, reach) * sizeof(int16_t);
}
constexpr size_t StripBytes(size_t height, size_t reach) {
  return ShiftedRows(height, reach) * (4 * simd::kSliceLanes * sizeof(int16_t) + 1);
}

// Where views show a slice that moves as `disparity`: of the views from -N to N, `stride` apart.
void FindOffsets(const ViewGrid& grid, int16_t disparity, size_t stride,
                 simd::SliceOffset* offsets);

// Geometry of the slice around `rect`.
void PlaceSlice(const ViewGrid& grid, int16_t disparity, const Rect& rect, SlicePlane* placed);

// What slices are made from.
struct SliceInput {
  const simd::Kernels& kernels;
  const LayeredDepth& surfaces;
  const SurfaceBands& bands;
};

// Copies the slice's pixels around `rect` (in pixels of the surfaces, whose outermost pixels go on
// beyond them) and spreads them for wide subapertures; `filtered` has room for the rows of one
// plane. Bands that have no disparity of the slice are not looked at. Samples and covers must be
// set.
void FillSlice(const SliceInput& input, const Slice& slice, const Rect& rect, int16_t* filtered,
               const SlicePlane& placed);

// Rows of a slice in a strip, kSliceLanes columns of the rectangle, as a column of views shows
// them: four planes, `plane` samples apart, and the mark of each row; kRowsAhead marks lie before
// the first.
struct ShiftedSlice {
  int16_t* samples = nullptr;
  int8_t* near = nullptr;
  size_t plane = 0;
  RowRange filled = {0, 0};  // rows outside of these are empty in all views
};

// Strips of a row (bits of SliceCover) that some view shows in the strip at column `x`.
constexpr uint64_t StripsOf(const SlicePlane& placed, int32_t x) {
  constexpr auto kStripColumns = static_cast<int32_t>(simd::kSliceLanes);
  const int32_t first = x / kStripColumns,
                last = (x + kStripColumns - 1 + 2 * placed.reach) / kStripColumns;
  return (uint64_t{2} << last) - (uint64_t{1} << first);
}

// Finds the rows of the strip at column `x` of the rectangle that views show in its rows `seen`,
// and writes the others that are read for these. The memory must be set.
void PlaceStrip(const SlicePlane& placed, int32_t x, const RowRange& seen, ShiftedSlice* shifted);

// Writes those of `rows` that are filled, moved by `offset`.
void ShiftSlice(const simd::Kernels& kernels, const SlicePlane& placed,
                const simd::SliceOffset& offset, int32_t x, const RowRange& rows,
                const ShiftedSlice& shifted);

}  // namespace starfocus

#endif  // STARFOCUS_LIB_SLICES_SLICE_PLANE_H_
